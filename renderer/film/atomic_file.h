// A file that appears under its name whole or not at all.
#pragma once

#include <string>

namespace rondure {

// Makes an empty file beside the target. `commit` moves it, once written, into the target's place; without
// that it is deleted.
class AtomicFile {
 public:
  // Throws std::runtime_error naming the target and the reason.
  explicit AtomicFile(std::string target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporary() const { return temporary_; }
  // Waits for the disk, then renames. Throws like the constructor.
  void commit();

 private:
  void forget();

  std::string target_;
  std::string temporary_;  // empty once committed
  int place_ = -1;         // among those that a signal deletes; -1: none was free
};

// From now on Ctrl-C, a hangup, a request to end and a limit of CPU time delete what is not committed before
// they end the program.
void delete_unfinished_on_signals();

// Throws as AtomicFile would, and leaves nothing behind: to learn of a bad name before hours of work.
void check_writable(const std::string& target);

}  // namespace rondure
