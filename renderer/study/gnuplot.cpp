#include "renderer/study/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <stdexcept>

namespace rondure {
namespace {

constexpr const char* colors[] = {"#1b6ca8", "#c1432e", "#e2972d", "#6a3d9a",
                                  "#2f8f4e", "#8c564b", "#444444"};

// Runs gnuplot in a folder, its output to a file. -1 where it cannot be started.
int run(const std::vector<std::string>& words, const std::string& folder, const std::string& log) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 255;
}

// In gnuplot's single quotes, where only they themselves count.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

std::string script_of(const std::string& svg, const std::string& data, const Plot& plot) {
  std::string s;
  s += "set terminal svg size 900,440 dynamic font 'sans-serif,13' background '#ffffff'\n";
  s += fmt::format("set output {}\n", quoted(svg));
  s += "set encoding utf8\nset logscale xy\nset format xy '10^{%T}'\nset grid\nunset mxtics\nunset "
       "mytics\nset key outside right center Left reverse samplen 2\n";
  s += fmt::format("set title {} noenhanced\nset xlabel {}\nset ylabel {}\n", quoted(plot.title),
                   quoted(plot.x_label), quoted(plot.y_label));
  s += "plot";
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    s += fmt::format(
        "{} {} index {} using 1:2 with linespoints lw 1.5 pt {} ps 0.6 lc rgb {} title {} noenhanced",
        k == 0 ? "" : ", \\\n    ", quoted(data), k, k + 4, quoted(colors[k % std::size(colors)]),
        quoted(plot.curves[k].name));
  }
  return s + "\n";
}

std::string data_of(const Plot& plot) {
  std::string out;
  for (const Curve& curve : plot.curves) {
    out += fmt::format("# {}\n", curve.name);
    bool any = false;
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      const bool fits =
          std::isfinite(curve.x[k]) && std::isfinite(curve.y[k]) && curve.x[k] > 0.0 && curve.y[k] > 0.0;
      if (fits) out += fmt::format("{:.17g} {:.17g}\n", curve.x[k], curve.y[k]);
      any = any || fits;
    }
    if (!any) out += "NaN NaN\n";  // an index without points would end the plot
    out += "\n\n";
  }
  return out;
}

}  // namespace

void require_gnuplot() {
  const std::string log = "/dev/null";
  if (run({"gnuplot", "--version"}, "/", log) != 0)
    throw std::runtime_error("gnuplot is not to be found; the study plots with it (Debian's gnuplot-nox)");
}

std::string plot_svg(const StudyFolder& folder, const std::string& name, const Plot& plot) {
  const std::string data = name + ".dat", script = name + ".gp", svg = name + ".svg", log = name + ".log";
  folder.write(data, data_of(plot));
  folder.write(script, script_of(svg, data, plot));
  const int status = run({"gnuplot", script}, folder.path(""), folder.path(log));
  std::string drawn = folder.read(svg);
  if (status != 0 || drawn.find("</svg>") == std::string::npos)
    throw std::runtime_error(fmt::format("{}: gnuplot failed: {}", folder.path(script), folder.read(log)));
  unlink(folder.path(log).c_str());
  // Inside a page the declaration before the element has no place.
  return drawn.substr(drawn.find("<svg"));
}

}  // namespace rondure
