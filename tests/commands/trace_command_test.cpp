// rondure trace as a user meets it: tables in, tables out.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "tests/catch.h"
#include "tests/commands/command_files.h"
#include "tests/paths.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

const std::string header = "ray,hit,t,x,y,z,nx,ny,nz,surface,patch,u,v";
constexpr double roundoff = 0x1p-53;

ProcessResult trace(const std::string& folder, std::vector<std::string> arguments,
                    const std::string& input = "") {
  arguments.insert(arguments.begin(), {"trace", "scene.json"});
  ProcessOptions options;
  options.folder = folder;
  options.input = input;
  return run_rondure(arguments, options);
}

}  // namespace

TEST_CASE("trace writes one line a ray, in the order of the rays", "[command]") {
  const std::string folder = folder_with("trace");
  // Rays from (0, 0, 3) at the points (x, 0.1, 0) beside and in the unit disk; more than one block of the
  // program's.
  constexpr int count = 40000;
  std::string rays = "ox,oy,oz,dx,dy,dz\n";
  const auto aim = [](int k) { return -1.5 + 3.0 * k / (count - 1); };
  for (int k = 0; k < count; ++k) rays += fmt::format("0,0,3,{:.17g},0.1,-3\n", aim(k));
  write_text_file(folder + "/rays.csv", rays);
  const ProcessResult result = trace(folder, {"--rays", "rays.csv"});
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.empty());
  const std::vector<std::string> lines = lines_of(result.out);
  REQUIRE(lines.size() == count + 1);
  CHECK(lines[0] == header);

  int wrong = 0, doubtful = 0;
  WorstCase worst;
  for (int k = 0; k < count; ++k) {
    const std::vector<std::string> fields = fields_of(lines[static_cast<std::size_t>(k) + 1]);
    if (fields.size() != 13 || fields[0] != std::to_string(k)) {
      ++wrong;
      continue;
    }
    // |o + t d|^2 = 1 in long double, the nearer root.
    const long double x = aim(k), a = x * x + 0.01L + 9.0L, b = 9.0L, c = 8.0L, discriminant = b * b - a * c;
    if (std::fabs(discriminant) < 1e-12L) {
      ++doubtful;
      continue;
    }
    if ((fields[1] == "1") != (discriminant > 0.0L)) ++wrong;
    if (fields[1] != "1") {
      if (lines[static_cast<std::size_t>(k) + 1] != std::to_string(k) + ",0,,,,,,,,,,,") ++wrong;
      continue;
    }
    // An error of 8 ulp in the surface moves t by 1 / cos of the angle of incidence, which is
    // sqrt(discriminant) over the ray's length.
    const long double t = (b - std::sqrt(discriminant)) / a;
    const double steep = static_cast<double>(std::sqrt(a / discriminant));
    const double error = static_cast<double>(std::fabs(static_cast<long double>(number_of(fields[2])) - t));
    worst.add(error, 16.0 * roundoff * steep, [&] { return fmt::format("t of ray {}", k); });
    const double px = number_of(fields[3]), py = number_of(fields[4]), pz = number_of(fields[5]);
    const double nx = number_of(fields[6]), ny = number_of(fields[7]), nz = number_of(fields[8]);
    worst.add(std::fabs(std::sqrt(px * px + py * py + pz * pz) - 1.0), 16.0 * roundoff,
              [&] { return fmt::format("radius of ray {}", k); });
    worst.add(std::hypot(nx - px, ny - py, nz - pz), 1e-12,
              [&] { return fmt::format("normal of ray {}", k); });
  }
  CHECK(wrong == 0);
  CHECK(doubtful <= 2);
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(worst.count() > 75000);  // three checks for each of the 25,000 and more rays that hit

  SECTION("the same to a file, and from standard input without the header line") {
    CHECK(trace(folder, {"--rays", "rays.csv", "-o", "hits.csv"}).out.empty());
    CHECK(read_text_file(folder + "/hits.csv") == result.out);
    CHECK(trace(folder, {"--rays", "-"}, rays.substr(rays.find('\n') + 1)).out == result.out);
    CHECK(names_in(folder) == std::vector<std::string>{"hits.csv", "rays.csv", "scene.json"});
  }
}

TEST_CASE("trace --all writes every hit in order of t", "[command]") {
  const std::string folder = folder_with("trace_all", R"({ "objects": [
    { "type": "sphere_tiling", "topology": "hemispheres" },
    { "type": "sphere_octant", "center": [0, 0, -4], "radius": 0.5 },
    { "type": "sphere", "center": [0, 0, 4], "radius": 0.25 } ] })");
  const ProcessResult result =
      trace(folder, {"--rays", "-", "--all"}, "0.1,0.05,10,0,0,-2\n9,9,9,0,0,1\n0.1,0.05,10,0,0,-2,3,4.8\n");
  REQUIRE(result.exit_code == 0);
  const std::vector<std::string> lines = lines_of(result.out);
  REQUIRE(lines.size() == 1 + 6 + 1 + 2);
  // z = c +- sqrt(R^2 - 0.1^2 - 0.05^2), t = (10 - z) / 2.
  const auto t_of = [](double center, double radius, double side) {
    return (10.0 - center - side * std::sqrt(radius * radius - 0.0125)) / 2.0;
  };
  const double expected[6] = {t_of(4, 0.25, 1), t_of(4, 0.25, -1), t_of(0, 1, 1),
                              t_of(0, 1, -1),   t_of(-4, 0.5, 1),  t_of(-4, 0.5, -1)};
  const std::string surfaces[6] = {"2", "2", "0", "0", "1", "1"};
  for (std::size_t k = 0; k < 6; ++k) {
    const std::vector<std::string> fields = fields_of(lines[k + 1]);
    CHECK(fields[0] == "0");
    CHECK(std::fabs(number_of(fields[2]) - expected[k]) <=
          64.0 * roundoff);  // t is below 8, z and the root err by few ulps
    CHECK(fields[9] == surfaces[k]);
  }
  CHECK(lines[7] == "1,0,,,,,,,,,,,");
  // With tmin = 3 and tmax = 4.8 the far sides of the small sphere (t = 3.11) and the near one of the middle
  // (4.50) remain.
  CHECK(number_of(fields_of(lines[8])[2]) == number_of(fields_of(lines[2])[2]));
  CHECK(number_of(fields_of(lines[9])[2]) == number_of(fields_of(lines[3])[2]));
}

TEST_CASE("trace refuses to write over what it reads", "[command]") {
  const std::string folder = folder_with("trace_over_inputs");
  write_text_file(folder + "/rays.csv", "0,0,3,0,0,-1\n");
  const std::string scene = read_text_file(folder + "/scene.json");
  for (const auto& [output, role] :
       {std::pair("scene.json", "the scene"), std::pair("rays.csv", "the input table")}) {
    const ProcessResult result = trace(folder, {"--rays", "rays.csv", "-o", output});
    CHECK(result.exit_code == 1);
    CHECK(result.err == fmt::format("rondure: error: {}: is {} and the output at once\n", output, role));
  }
  CHECK(read_text_file(folder + "/scene.json") == scene);
  CHECK(read_text_file(folder + "/rays.csv") == "0,0,3,0,0,-1\n");
}

TEST_CASE("trace points at what is wrong with a table", "[command]") {
  const std::string folder = folder_with("trace_errors");
  struct Case {
    std::string row, message;
  };
  const Case cases[] = {
      {"0,0,3,0,0",
       "2:10: expected 6 columns at least (ox,oy,oz,dx,dy,dz,tmin,tmax), found 5\n    0,0,3,0,0\n"
       "             ^"},
      {"0,0,3,0,0,x", "2:11: \"dz\" must be a number, found \"x\"\n    0,0,3,0,0,x\n              ^"},
      {"0,0,3,0,0,+-1", "2:11: \"dz\" must be a number, found \"+-1\"\n    0,0,3,0,0,+-1\n              ^"},
      {"0,0,3,0,0,0", "2:7: the direction is zero\n    0,0,3,0,0,0\n          ^"},
      {"0,0,3,0,0,1e400", "2:11: \"dz\" is out of a double's range\n    0,0,3,0,0,1e400\n              ^"},
      {"0,0,3,0,0,inf", "2:11: origin and direction must be finite\n    0,0,3,0,0,inf\n              ^"},
      {"0,-2e297,3,0,1,0", "2:3: a ray from beyond 1e+297 cannot be followed\n    0,-2e297,3,0,1,0\n      ^"},
      {"0,0,3,0,0,-1,nan",
       "2:14: \"tmin\" must be a number, found \"nan\"\n    0,0,3,0,0,-1,nan\n                 ^"},
  };
  for (const Case& wrong : cases) {
    write_text_file(folder + "/rays.csv", "0,0,3,0,0,-1\n" + wrong.row + "\n");
    const ProcessResult result = trace(folder, {"--rays", "rays.csv", "-o", "hits.csv"});
    CHECK(result.err == "rondure: error: rays.csv:" + wrong.message + "\n");
    CHECK(result.exit_code == 1);
    // The first row was good and had been traced, but nothing half-written is left.
    CHECK(names_in(folder) == std::vector<std::string>{"rays.csv", "scene.json"});
  }
  write_text_file(folder + "/hits.csv", "earlier");
  CHECK(trace(folder, {"--rays", "rays.csv", "-o", "hits.csv"}).exit_code == 1);
  CHECK(read_text_file(folder + "/hits.csv") == "earlier");
  CHECK(trace(folder, {"--rays", "nowhere.csv"}).err ==
        "rondure: error: nowhere.csv: cannot be opened: No such file or directory\n");
  CHECK(trace(folder, {"--rays", "."}).err == "rondure: error: .: is a folder, not a file\n");
  // Standard input that cannot be read is no empty table.
  for (const auto& [place, reason] :
       {std::pair{"< .", "Is a directory"}, std::pair{"<&-", "Bad file descriptor"}}) {
    ProcessOptions options;
    options.folder = folder;
    const std::string command = std::string("exec \"$0\" trace scene.json --rays - ") + place;
    const ProcessResult result = run_process({"/bin/sh", "-c", command, program_path()}, options);
    CHECK(result.exit_code == 1);
    CHECK(result.err ==
          std::string("rondure: error: standard input: reading failed after line 0: ") + reason + "\n");
  }
}

}  // namespace rondure
