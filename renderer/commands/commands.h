// The sub-commands of the program, one file each.
//
// For every sub-command NAME there are here the options that it takes, a struct filled from the command line,
// and its action, run_NAME, the work of NAME.cpp. command_line.cpp alone knows CLI11, which takes longer to
// compile than all of these together: there add_NAME describes the sub-command and its options, and says that
// run_NAME is what to do. Actions run after the whole command line is read and the plugins are loaded. They
// throw to fail: only main catches, prints "rondure: error: ..." and returns 1. Results go to the named file
// or to standard output, all else to standard error.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/registry.h"
#include "renderer/scene/overrides.h"

namespace rondure {

// What every sub-command with a scene shares: the file, --set and --solver, and when rendering more.
struct SceneOptions {
  std::string path;
  SceneOverrides overrides;
};

struct RenderCommand {
  SceneOptions scene;
  std::string output;  // OpenEXR; the scene's name where it is empty
  std::string png;     // none where it is empty
  std::string crop;    // x0,y0,x1,y1, or empty
  double exposure = 0.0;
  int threads = 0;  // 0: all processors
  bool resume = false, quiet = false;
};
void run_render(const Registry& registry, RenderCommand options);

struct TraceCommand {
  SceneOptions scene;
  std::string rays;
  std::string output = "-";
  bool all = false;
  bool certify = false;
};
void run_trace(const Registry& registry, const TraceCommand& options);

struct EvalCommand {
  SceneOptions scene;
  std::string at, directions;  // tables, one of the two
  std::string output = "-";
};
void run_eval(const Registry& registry, const EvalCommand& options);

struct InfoCommand {
  SceneOptions scene;
  bool json = false;
  bool no_mass = false;
  bool no_continuity = false;
  bool certify = false;
};
void run_info(const Registry& registry, const InfoCommand& options);

struct ExportCommand {
  SceneOptions scene;
  std::string output = "-";
  std::string form = "triangles";
};
void run_export(const Registry& registry, const ExportCommand& options);

struct StudyCommand {
  std::string study;                  // corner-normals, parametrisation or precision
  std::vector<std::string> families;  // all where there are none
  std::string scene;                  // whose objects corner-normals studies instead
  std::string output;                 // a folder; the study's name where it is empty
  std::vector<std::string> plugins;   // of the command line, for the page to repeat
  bool quick = false, quiet = false;
};
void run_study(const Registry& registry, const StudyCommand& options);

void run_validate(const Registry& registry, const SceneOptions& options);
void run_list(const Registry& registry);
void run_describe(const Registry& registry, const std::string& name);

}  // namespace rondure
