#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/decal_columns.h"
#include "scene/problems.h"

namespace wrinkle::scene {

/// The rows of a table of decals while they are read, and what is wrong with them: the first mistakes in full, the rest
/// as a number. A place is a line of a text file; of other files, a row.
class DecalReader {
public:
    enum class Places { lines, rows };
    /// `textures`: how many textures rows may name.
    DecalReader(const std::string& file, std::size_t textures, Places places)
        : problems_(file), textures_(textures), places_(places) {}

    void complain(std::uint32_t place, std::string text);

    /// Names of the columns in the order of the fields; a column is null where no such one is known.
    void read_header(const std::vector<std::string>& names, std::uint32_t place);
    const std::vector<const DecalColumn*>& header() const { return header_; }

    /// A row is begun, its fields are read, and it is ended.
    void begin_row(std::uint32_t place);
    /// Empty text is the default.
    void read_text(std::size_t column, std::string_view field);
    void read_number(std::size_t column, double value);
    void end_row();

    /// Throws Error if anything was wrong.
    std::vector<Projector> finish();

private:
    void complain_of(const DecalColumn& column, const std::string& found, const std::string& wrong);

    Problems problems_;
    std::size_t textures_, count_ = 0;
    Places places_;
    std::uint32_t place_ = 0, last_ = 0;  ///< of the row being read; of the last mistake
    std::vector<const DecalColumn*> header_;
    std::vector<Projector> rows_;
};

}  // namespace wrinkle::scene
