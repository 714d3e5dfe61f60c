#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace wrinkle::io {

/// The attribute of a picture that holds what its provenance was.
inline constexpr char kProvenance[] = "wrinkle/provenance";

/// A hash over all that goes into a picture.
class Provenance {
public:
    Provenance();
    ~Provenance();
    Provenance(const Provenance&) = delete;
    Provenance& operator=(const Provenance&) = delete;

    void add(std::string_view text);
    /// A file by its name, size and time of change, as make goes by: reading gigabytes to learn that nothing changed
    /// would take as long as the work. Its folder does not count, which may be called otherwise on another machine.
    void add_file(const std::filesystem::path& file);

    std::string digest();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Whether there is a picture of this provenance, and all of it.
bool is_finished(const std::filesystem::path& file, const std::string& provenance);

}  // namespace wrinkle::io
