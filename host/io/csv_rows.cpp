#include "io/csv_rows.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <vector>

#include "wrinkle/error.h"

namespace wrinkle::io {

namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// Collects the cells that libcsv finds, and hands on each row. No exception may pass through libcsv, which is C: the
/// callbacks keep it, and it is thrown again when libcsv has returned.
class Parser {
public:
    Parser(const CsvRowTaker& take, const std::string& name) : take_(take), name_(name) {
        csv_init(&parser_, CSV_REPALL_NL | CSV_STRICT | CSV_STRICT_FINI);
    }
    ~Parser() { csv_free(&parser_); }
    Parser(const Parser&) = delete;
    Parser& operator=(const Parser&) = delete;

    void parse(std::string_view text) {
        const std::size_t parsed = csv_parse(&parser_, text.data(), text.size(), on_cell, on_row, this);
        rethrow();
        if (parsed != text.size())
            throw Error(fmt::format("{}:{}: a quote within a cell; quote the cell and double it", name_, line_));
    }

    void finish() {
        const bool closed = csv_fini(&parser_, on_cell, on_row, this) == 0;
        rethrow();
        if (!closed) throw Error(fmt::format("{}:{}: a quote is not closed", name_, line_));
    }

    std::uint32_t line() const { return line_; }

private:
    static void on_cell(void* data, std::size_t size, void* self) noexcept {
        static_cast<Parser*>(self)->guarded([&](Parser& p) { p.add_cell({static_cast<const char*>(data), size}); });
    }
    static void on_row(int end, void* self) noexcept {
        static_cast<Parser*>(self)->guarded([&](Parser& p) { p.end_row(end); });
    }

    template <class F>
    void guarded(const F& step) noexcept {
        if (thrown_) return;
        try {
            step(*this);
        } catch (...) { thrown_ = std::current_exception(); }
    }

    void rethrow() {
        if (thrown_) std::rethrow_exception(thrown_);
        if (csv_error(&parser_) == CSV_ENOMEM) throw std::bad_alloc();
    }

    void add_cell(std::string_view cell) {
        last_end_ = 0;
        text_ += cell;
        ends_.push_back(text_.size());
        inner_lines_ += static_cast<std::uint32_t>(std::ranges::count(cell, '\n'));
    }

    void end_row(int end) {
        if (last_end_ == '\r' && end == '\n') {
            last_end_ = 0;
            return;
        }
        if (!ends_.empty()) {
            cells_.clear();
            std::size_t begin = 0;
            for (const std::size_t at : ends_) {
                cells_.push_back(std::string_view(text_).substr(begin, at - begin));
                begin = at;
            }
            take_(line_, cells_);
        }
        line_ += inner_lines_ + 1;
        text_.clear(), ends_.clear();
        inner_lines_ = 0, last_end_ = end;
    }

    const CsvRowTaker& take_;
    const std::string& name_;
    csv_parser parser_;
    std::exception_ptr thrown_;
    std::string text_;               ///< the cells of this row, one after another
    std::vector<std::size_t> ends_;  ///< where each cell ends in text_
    std::vector<std::string_view> cells_;
    std::uint32_t line_ = 1, inner_lines_ = 0;  ///< the line that the row begins in; line breaks within its cells
    int last_end_ = 0;                          ///< the line end just read, '\r' or '\n'; 0 after a cell
};

/// Spreadsheets in some countries separate columns by semicolons. Throws Error when the header row has those, or tabs,
/// and no comma.
void check_separator(std::string_view header, const std::string& name, std::uint32_t line) {
    if (header.find(',') != std::string_view::npos) return;
    const char* found = nullptr;
    if (header.find(';') != std::string_view::npos)
        found = "';'";
    else if (header.find_last_not_of(" \t\r\n") > header.find('\t', header.find_first_not_of(" \t")))
        found = "tabs";
    if (found != nullptr)
        throw Error(fmt::format("{}:{}: separated by {}: save with commas between columns, and points in numbers", name,
                                line, found));
}

}  // namespace

void read_csv_rows(std::string_view text, const std::string& name, CsvComments comments, const CsvRowTaker& take) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    if (text.find('\0') != std::string_view::npos)
        throw Error(fmt::format("{}: no CSV in ASCII or UTF-8: it holds zero bytes", name));
    Parser parser(take, name);
    bool header = true, quoted = false;  // quoted: the line begins within a quoted cell
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size() - 1);
        const std::string_view line = text.substr(0, end + 1);
        const std::size_t first = quoted ? 0 : line.find_first_not_of(" \t\r\n");
        if (comments == CsvComments::lines && !quoted && first != std::string_view::npos && line[first] == '#') {
            parser.parse(line.substr(line.find_first_of("\r\n") == std::string_view::npos ? line.size() : end));
        } else {
            if (header && first != std::string_view::npos) {
                check_separator(line, name, parser.line());
                header = false;
            }
            parser.parse(line);
            quoted ^= std::ranges::count(line, '"') % 2 == 1;
        }
        text.remove_prefix(end + 1);
    }
    parser.finish();
}

}  // namespace wrinkle::io
