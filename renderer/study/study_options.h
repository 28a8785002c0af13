// What a study was asked for, and how it stops when it is asked to.
#pragma once

#include <string>
#include <vector>

#include "renderer/render/progress.h"
#include "renderer/study/folder.h"

namespace rondure {

struct StudyOptions {
  std::vector<std::string> families;  // all when empty
  std::string scene;                  // whose objects are studied instead, where it is not empty
  std::string output;                 // folder
  bool quick = false;
  bool quiet = false;
  std::string command;  // that reproduces the study, for the page
};

// Throws std::runtime_error after Ctrl-C, saying how to go on.
void stop_if_interrupted(Progress& progress, const StudyFolder& folder);

}  // namespace rondure
