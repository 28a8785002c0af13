// The sums of a render in a file, so that a later run goes on from them to the same bits as one run straight
// through.
#pragma once

#include <string>

#include "renderer/film/film.h"

namespace rondure {

// The file's name for the picture at `image`.
std::string resume_path(const std::string& image);

// Keeps the whole chunks of the film. `key` tells what is rendered: everything that the sums depend on but
// the count of samples. Atomic. Throws std::runtime_error naming the file.
void write_resume_state(const std::string& path, const std::string& key, const Film& film);

// Fills `film` from the file; false when there is none. Throws std::runtime_error when the file is damaged,
// or its key is another.
bool read_resume_state(const std::string& path, const std::string& key, Film& film);

}  // namespace rondure
