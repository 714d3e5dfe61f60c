#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/reference/vec.h"

/// Golden tables, which are CSV with named columns. data/golden/README.md says what they hold.
namespace wrinkle::reference {

class GoldenTable {
public:
    explicit GoldenTable(const std::string& path) {
        std::ifstream file(path);
        if (!file) throw std::runtime_error("no golden table " + path);
        std::string line;
        std::getline(file, line);
        const std::vector<std::string> names = split(line);
        for (std::size_t i = 0; i < names.size(); ++i) columns_[names[i]] = i;
        while (std::getline(file, line))
            if (!line.empty()) rows_.push_back(split(line));
    }

    std::size_t size() const { return rows_.size(); }
    bool has(const std::string& name) const { return columns_.contains(name); }
    const std::vector<std::string>& cells(std::size_t row) const { return rows_[row]; }

    /// A number, which may also be nan or inf.
    double number(std::size_t row, const std::string& name) const {
        return std::strtod(text(row, name).c_str(), nullptr);
    }
    const std::string& text(std::size_t row, const std::string& name) const {
        const auto column = columns_.find(name);
        if (column == columns_.end()) throw std::runtime_error("no column " + name + " in a golden table");
        return rows_[row].at(column->second);
    }
    /// Columns name.x, name.y, name.z.
    template <class T = real>
    Vec<T> vec(std::size_t row, const std::string& name) const {
        return {T(number(row, name + ".x")), T(number(row, name + ".y")), T(number(row, name + ".z"))};
    }
    /// Columns name.x, name.y, or name.s, name.t.
    template <class T = real>
    Vec2<T> vec2(std::size_t row, const std::string& name) const {
        const bool xy = has(name + ".x");
        return {T(number(row, name + (xy ? ".x" : ".s"))), T(number(row, name + (xy ? ".y" : ".t")))};
    }
    /// What messages call a row: "hard/near_horizon case 212".
    std::string label(std::size_t row) const {
        return text(row, "set") + "/" + text(row, "category") + " case " + text(row, "case");
    }

private:
    static std::vector<std::string> split(const std::string& line) {
        std::vector<std::string> cells;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
        if (!cells.empty() && !cells.back().empty() && cells.back().back() == '\r') cells.back().pop_back();
        return cells;
    }

    std::map<std::string, std::size_t> columns_;
    std::vector<std::vector<std::string>> rows_;
};

#ifdef WRINKLE_SOURCE_DIR
inline GoldenTable golden(const std::string& name) {
    return GoldenTable(WRINKLE_SOURCE_DIR "/data/golden/" + name + ".csv");
}
#endif

}  // namespace wrinkle::reference
