#include "renderer/film/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "renderer/film/ending_signals.h"

namespace rondure {
namespace {

[[noreturn]] void refuse(const std::string& target, const char* reason) {
  throw std::runtime_error(fmt::format("{}: cannot write: {}", target, reason));
}
[[noreturn]] void refuse(const std::string& target, int error) { refuse(target, std::strerror(error)); }

// A signal handler may neither wait nor allocate: the names are kept where they stay.
struct Unfinished {
  std::atomic<bool> taken{false}, named{false};
  std::array<char, PATH_MAX> name{};
};
static_assert(std::atomic<bool>::is_always_lock_free);
std::array<Unfinished, 16> unfinished;

int remember(const std::string& name) {
  for (std::size_t k = 0; name.size() < PATH_MAX && k < unfinished.size(); ++k) {
    Unfinished& place = unfinished[k];
    if (place.taken.exchange(true)) continue;
    name.copy(place.name.data(), name.size());
    place.name[name.size()] = '\0';
    place.named = true;
    return static_cast<int>(k);
  }
  return -1;
}

void end_by(int signal) {
  for (const Unfinished& place : unfinished)
    if (place.named) unlink(place.name.data());
  std::signal(signal, SIG_DFL);
  raise(signal);
}

// Data that is renamed before it is on the disk may be lost under the new name.
int synchronise(const std::string& path, int flags) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = fsync(file) == 0 ? 0 : errno;
  close(file);
  return error;
}

// Where a chain of links leads, also to a file that does not exist yet. Throws for a chain without an end.
std::string behind_links(const std::string& target) {
  constexpr int longest_chain = 40;  // the kernel's own limit
  std::error_code error;
  std::filesystem::path path = target;
  for (int k = 0; std::filesystem::is_symlink(path, error); ++k) {
    // As /dev/stdout is: a file behind it may hold what others wrote, which renaming would lose.
    if (std::filesystem::canonical(path.parent_path(), error).string().starts_with("/proc/"))
      refuse(target,
             "it is a stream that is open already; - is standard output, where that can be written to");
    const std::filesystem::path next = std::filesystem::read_symlink(path, error);
    if (k == longest_chain) refuse(target, ELOOP);
    if (error) refuse(target, error.value());
    path = path.parent_path() / next;  // an absolute one takes the place of both
  }
  return path.string();
}

}  // namespace

AtomicFile::AtomicFile(std::string target) : target_(std::move(target)) {
  // The file that a link leads to gives way, and the link stays.
  target_ = behind_links(target_);
  std::error_code ignored;
  const auto status = std::filesystem::status(target_, ignored);
  if (std::filesystem::is_directory(status)) refuse(target_, EISDIR);
  // Renaming would put a plain file in a device's place.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    refuse(target_, "not a regular file");
  }
  const std::string name = target_ + ".part-XXXXXX";
  std::vector<char> buffer(name.begin(), name.end());
  buffer.push_back('\0');
  const int file = mkostemp(buffer.data(), O_CLOEXEC);
  if (file < 0) refuse(target_, errno);
  temporary_.assign(buffer.data());
  place_ = remember(temporary_);
  // mkstemp makes files for their owner alone; a picture gets what the user's mask allows.
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(file, 0666 & ~mask);
  close(file);
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
  forget();
}

void AtomicFile::forget() {
  if (place_ < 0) return;
  Unfinished& place = unfinished[static_cast<std::size_t>(place_)];
  place.named = false, place.taken = false;
  place_ = -1;
}

void AtomicFile::commit() {
  if (const int error = synchronise(temporary_, O_RDONLY)) refuse(target_, error);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) refuse(target_, errno);
  temporary_.clear();
  forget();
}

void delete_unfinished_on_signals() {
  for (const int signal : ending_signals) {
    struct sigaction action {};
    // What was ignored stays so: the program may run behind nohup.
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action.sa_handler = end_by;
    sigaction(signal, &action, nullptr);
  }
}

void check_writable(const std::string& target) { AtomicFile{target}; }

}  // namespace rondure
