#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problems.h"
#include "scene/decal_columns.h"

namespace wrinkle::scene {

/// The rows of a table of decals while they are read, or checked, and what is wrong with them: the first mistakes in
/// full, the rest as a number. Mistakes are told in the words of the table's form.
class DecalReader {
public:
    enum class Form { csv, npy, toml, memory };
    /// `file` as messages show it. `textures`: how many textures rows may name.
    DecalReader(const std::string& file, std::size_t textures, Form form)
        : problems_(file), textures_(textures), form_(form) {}

    /// About the row being read; `line` is 0 where the form has no lines.
    void complain(std::uint32_t line, std::string text);
    /// About the file as a whole.
    void complain_of_file(std::uint32_t line, std::string text);

    /// Takes the names of the columns, in the order of the fields. In header() a column that is not known is null.
    void read_header(std::span<const std::string> names, std::uint32_t line);
    const std::vector<const DecalColumn*>& header() const { return header_; }

    /// For every row: begin_row(), one call for each field, end_row().
    void begin_row(std::uint32_t line);
    /// The fields that follow are in this line.
    void go_to(std::uint32_t line) { line_ = line; }
    /// An empty field leaves the default.
    void read_text(const DecalColumn& column, std::string_view field);
    void read_number(const DecalColumn& column, double value);
    /// Notes that a field has a type that the column cannot take.
    void refuse(const DecalColumn& column, const std::string& found, const std::string& wrong);
    void end_row() { check_together(rows_.back(), rows_.back().line); }
    /// Checks a row that was made in code.
    void check(const Projector& row);
    /// Rows that another reader finished.
    void append(std::vector<Projector> rows);

    /// Throws Error if anything was wrong.
    std::vector<Projector> finish();

private:
    std::size_t begun() const { return rows_.size() + checked_; }
    bool by_key() const { return form_ == Form::toml || form_ == Form::memory; }
    void check_together(const Projector& row, std::uint32_t line);
    std::string named(const DecalColumn& column) const;
    std::string listed(std::initializer_list<const char*> columns) const;

    Problems problems_;
    std::size_t textures_, count_ = 0, checked_ = 0;
    Form form_;
    std::uint32_t line_ = 0, last_line_ = 0;  ///< of the field being read; of the last mistake
    std::size_t last_row_ = 0;
    std::vector<const DecalColumn*> header_;
    std::vector<Projector> rows_;
};

}  // namespace wrinkle::scene
