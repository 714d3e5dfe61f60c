#pragma once

#include <filesystem>
#include <string>

/// Names of files that are not complete yet: ".NAME.RANDOM.partial" beside the file that they will become.
namespace wrinkle {

/// A new name each time. Process numbers would not do: in containers each process has the same one.
std::filesystem::path temporary_name(const std::filesystem::path& target);

/// Removes the temporary files of `target` whose writers are gone, which is those that nobody holds a lock on.
void remove_abandoned(const std::filesystem::path& target);

/// Takes the lock that says that a temporary file is being written. False when it is somebody else's, or has been
/// removed by somebody who came first.
bool hold_temporary(int descriptor);

/// As long as this lives, a signal that ends the process removes the file; see remove_temporaries_on_signals().
class DoomedFile {
public:
    explicit DoomedFile(const std::filesystem::path& file);
    ~DoomedFile();
    DoomedFile(DoomedFile&& other) noexcept;
    DoomedFile& operator=(DoomedFile&& other) noexcept;

private:
    int slot_ = -1;
};

/// From now on SIGINT, SIGTERM and SIGHUP remove all doomed files before they end the process. For programs; a library
/// leaves signals to the program that it is in.
void remove_temporaries_on_signals();

}  // namespace wrinkle
