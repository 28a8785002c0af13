// Raw nets from a scene: what is read, and what each mistake says.
#include <fmt/format.h>

#include "renderer/bezier/rational.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

const std::string bilinear = R"([[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[2,2,2,2]]])";

std::string tensor(const std::string& degree, const std::string& net) {
  return R"({"type": "bezier", "patches": [{"kind": "tensor", "degree": )" + degree + R"(, "net": )" + net +
         "}]}";
}

std::string triangle(const std::string& degree, const std::string& net) {
  return R"({"type": "bezier", "patches": [{"kind": "triangle", "degree": )" + degree + R"(, "net": )" + net +
         "}]}";
}

}  // namespace

TEST_CASE("tensor and triangular nets are read in their order", "[surfaces]") {
  const Surface surface = build_family(tensor("[1, 1]", bilinear));
  REQUIRE(surface.patches.size() == 1);
  CHECK_FALSE(surface.closed);
  CHECK(net_point(surface.patches[0], 0.0, 1.0) == dvec3(0.0, 1.0, 0.0));
  CHECK(net_point(surface.patches[0], 1.0, 0.0) == dvec3(1.0, 0.0, 0.0));
  CHECK(net_point(surface.patches[0], 1.0, 1.0) == dvec3(1.0, 1.0, 1.0));

  for (const char* keys : {R"({"100":[3,0,0,1],"010":[0,4,0,1],"001":[0,0,5,1]})",
                           R"({"0,0,1":[0,0,5,1],"1,0,0":[3,0,0,1],"010":[0,4,0,1]})"}) {
    const Surface flat = build_family(triangle("1", keys));
    CHECK(net_point(flat.patches[0], 1.0, 0.0) == dvec3(3.0, 0.0, 0.0));
    CHECK(net_point(flat.patches[0], 0.0, 1.0) == dvec3(0.0, 4.0, 0.0));
    CHECK(net_point(flat.patches[0], 0.0, 0.0) == dvec3(0.0, 0.0, 5.0));
  }
}

TEST_CASE("triangles of degree 10 and more are keyed with commas", "[surfaces]") {
  std::string net;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10 - i; ++j) {
      const int x = i, y = j, k = 10 - i - j;
      net += fmt::format("{}\"{},{},{}\":[{},{},0,1]", net.empty() ? "{" : ",", x, y, k, x, y);
    }
  }
  const Surface surface = build_family(triangle("10", net + "}"));
  const dvec3 p = net_point(surface.patches[0], 0.25, 0.5);
  CHECK(p.x == Approx(2.5));
  CHECK(p.y == Approx(5.0));
}

TEST_CASE("closed says so, and a file is the same as what it holds", "[surfaces]") {
  CHECK(build_family(
            R"({"type": "bezier", "closed": true, "patches": [{"kind": "tensor", "degree": [1, 1], "net": )" +
            bilinear + "}]}")
            .closed);
  const Surface surface = build_family(R"({"type": "bezier", "file": "square.json"})");
  REQUIRE(surface.patches.size() == 2);
  CHECK(std::holds_alternative<TensorNet>(surface.patches[0]));
  CHECK(std::holds_alternative<TriangleNet>(surface.patches[1]));
  const std::string missing = family_error(R"({"type": "bezier", "file": "nowhere.json"})");
  CHECK(missing.find("object.json:1:28: cannot read ") != std::string::npos);  // where the scene names it
  CHECK(missing.find("nowhere.json: No such file or directory\n") != std::string::npos);
}

TEST_CASE("each mistake in a net has its message", "[surfaces]") {
  CHECK(complaint(R"({"type": "bezier", "patches": []})") == "there is no patch");
  CHECK(complaint(R"({"type": "bezier", "file": "square.json", "patches": []})") ==
        "give either \"patches\" or \"file\", not both");
  CHECK(complaint(R"({"type": "bezier", "patches": [{"net": []}]})") ==
        "the object.patches[0]: \"degree\" is missing");
  CHECK(complaint(tensor("[1]", bilinear)) ==
        "the degree of a tensor patch is an array of two integers, [along u, along v]");
  CHECK(complaint(tensor("[0, 1]", bilinear)) == "a degree must be an integer from 1 to 24");
  CHECK(complaint(tensor("[1, 25]", bilinear)) == "a degree must be an integer from 1 to 24");
  CHECK(complaint(tensor("[1, 1.5]", bilinear)) == "a degree must be an integer from 1 to 24");
  CHECK(complaint(tensor("[2, 1]", bilinear)) ==
        "the net of a tensor patch of degree [2, 1] is an array of 3 rows, not 2");
  CHECK(complaint(tensor("[1, 2]", bilinear)) == "a row of this net is an array of 3 control points, not 2");
  CHECK(complaint(tensor("[1, 1]", R"([[[0,0,0,1],[0,1,0]],[[1,0,0,1],[2,2,2,2]]])")) ==
        "a control point is an array of four numbers, [w x, w y, w z, w]");
  CHECK(complaint(tensor("[1, 1]", R"([[[0,0,0,1],[0,1,"a",1]],[[1,0,0,1],[2,2,2,2]]])")) ==
        "a coordinate of a control point must be a finite number");
  CHECK(complaint(tensor("[1, 1]", R"([[[0,0,0,0],[0,1,0,0]],[[1,0,0,0],[2,2,2,0]]])")) ==
        "every weight is zero: the patch has no point in space (w comes last)");
  CHECK(complaint(triangle("1", "[]")) ==
        "the net of a triangle is an object with keys \"ijk\" for u^i v^j w^k, or \"i,j,k\"");
  const std::string start = R"({"100":[3,0,0,1],"010":[0,4,0,1])";
  CHECK(complaint(triangle("1", start + "}")) == "control point \"001\" is missing");
  for (const char* key : {"011", "1", "0011", "0,1", "0,,1", "a01", "0,0,1,", "0,0,01x", ""}) {
    INFO(key);
    CHECK(complaint(triangle("1", fmt::format("{},\"{}\":[0,0,5,1]}}", start, key))) ==
          fmt::format("\"{}\" is no index of this net: \"ijk\" or \"i,j,k\" with i + j + k = 1", key));
  }
  CHECK(complaint(triangle("1", start + R"(,"1,0,0":[0,0,5,1]})")) ==
        "control point \"1,0,0\" is given twice");
  CHECK(complaint(triangle("1", R"({"100":[0,0,0,0],"010":[0,4,0,0],"001":[1,1,1,0]})")) ==
        "every weight is zero: the patch has no point in space (w comes last)");
}

}  // namespace rondure
