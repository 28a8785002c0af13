#include "renderer/film/resume_state.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "renderer/film/atomic_file.h"
#include "renderer/sampling/hash.h"

namespace rondure {
namespace {

// In the machine's own byte order: a state file goes nowhere else.
constexpr char magic[] = "rondure state 2\n";

[[noreturn]] void damaged(const std::string& path) {
  throw std::runtime_error(fmt::format("{}: the file is damaged; delete it to start anew", path));
}

struct Header {
  std::uint32_t key_size = 0;
  std::uint32_t samples = 0;
  std::uint64_t rejected = 0;
  std::uint64_t pixels = 0;
  std::uint64_t checksum = 0;  // of the sums, and of what stands above
};

std::uint64_t checksum(const Header& header, const std::vector<PixelSums>& sums) {
  std::uint64_t hash = hash_with(hash_with(header.samples, header.rejected), header.pixels);
  for (const PixelSums& pixel : sums) {
    for (const double value : pixel.values) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      hash = hash_with(hash, bits);
    }
  }
  return hash;
}

}  // namespace

std::string resume_path(const std::string& image) { return image + ".state"; }

void write_resume_state(const std::string& path, const std::string& key, const Film& film) {
  AtomicFile target(path);
  std::ofstream file(target.temporary(), std::ios::binary);
  Header header{static_cast<std::uint32_t>(key.size()), film.whole_samples(), film.whole_rejected,
                film.whole.size()};
  header.checksum = checksum(header, film.whole);
  file.write(magic, sizeof magic);
  file.write(reinterpret_cast<const char*>(&header), sizeof header);
  file.write(key.data(), static_cast<std::streamsize>(key.size()));
  file.write(reinterpret_cast<const char*>(film.whole.data()),
             static_cast<std::streamsize>(film.whole.size() * sizeof(PixelSums)));
  file.close();
  if (!file) throw std::runtime_error(fmt::format("{}: cannot write: the disk is full or failed", path));
  target.commit();
}

bool read_resume_state(const std::string& path, const std::string& key, Film& film) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return false;
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw std::runtime_error(fmt::format("{}: cannot hold samples: not a regular file", path));
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)  // not to be written over: it may hold a long render
    throw std::runtime_error(fmt::format("{}: cannot read the samples to resume from: {}", path,
                                         std::generic_category().message(errno)));
  char mark[sizeof magic];
  Header header;
  file.read(mark, sizeof mark);
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!file || std::memcmp(mark, magic, sizeof magic) != 0 || header.key_size > 65536) damaged(path);
  std::string found(header.key_size, '\0');
  file.read(found.data(), header.key_size);
  if (!file) damaged(path);
  if (found != key) {
    throw std::runtime_error(
        fmt::format("{}: holds another render; delete it or choose another output\n  found:  "
                    "{}\n  wanted: {}",
                    path, found, key));
  }
  if (header.pixels != film.whole.size()) damaged(path);
  file.read(reinterpret_cast<char*>(film.whole.data()),
            static_cast<std::streamsize>(film.whole.size() * sizeof(PixelSums)));
  if (!file || file.peek() != std::char_traits<char>::eof() ||
      checksum(header, film.whole) != header.checksum)
    damaged(path);
  film.samples = header.samples;
  film.rejected = film.whole_rejected = header.rejected;
  return true;
}

}  // namespace rondure
