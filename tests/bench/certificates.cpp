#include "tests/bench/certificates.h"

#include <fmt/core.h>

#include "renderer/intersect/certificate.h"
#include "tests/bench/ray_sets.h"
#include "tests/bench/stopwatch.h"
#include "tests/surfaces/build_family.h"

namespace rondure::bench {
namespace {

struct Contender {
  const char* name;
  Tracer tracer;
  Certifier certifier;
  std::vector<double> ratio[2] = {};
  double pieces = 0.0, unresolved = 0.0;

  Contender(const char* text, const Surface& surface, Solver solver)
      : name(text), tracer({{surface, solver}}), certifier(tracer) {}
};

}  // namespace

void print_certificates(int rounds) {
  const Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})"),
                kites = build_family(R"({"type": "sphere_tiling", "topology": "icosahedron_quads"})");
  std::vector<std::unique_ptr<Contender>> contenders;
  const auto add = [&](const char* name, const Surface& surface, Solver solver) {
    contenders.push_back(std::make_unique<Contender>(name, surface, solver));
  };
  add("sphere", build_family(R"({"type": "sphere"})"), Solver::newton);
  add("cube, quadric", cube, Solver::quadric);
  add("cube, newton", cube, Solver::newton);
  add("octants, newton", build_family(R"({"type": "sphere_octant"})"), Solver::newton);
  add("60 kites, newton", kites, Solver::newton);
  const std::vector<Ray> sets[2] = {coherent_rays(64), incoherent_rays(4096)};
  std::size_t sink = 0;
  for (int round = 0; round < rounds; ++round)
    for (int set = 0; set < 2; ++set)
      for (const auto& c : contenders) {
        std::vector<Hit> hits(sets[set].size());
        const double plain = seconds([&] {
          for (std::size_t k = 0; k < hits.size(); ++k) hits[k] = c->tracer.closest(sets[set][k]);
        });
        double pieces = 0.0, unresolved = 0.0;
        const double proofs = seconds([&] {
          for (std::size_t k = 0; k < hits.size(); ++k) {
            const Certificate proof = c->certifier.certify(sets[set][k], hits[k]);
            pieces += static_cast<double>(proof.pieces), unresolved += !proof;
            sink += static_cast<bool>(proof);
          }
        });
        c->ratio[set].push_back(proofs / plain);
        if (set == 1) c->pieces = pieces / static_cast<double>(hits.size()), c->unresolved = unresolved;
      }
  fmt::print("\ncertificates: their time over that of the closest hits ({} proofs)\n", sink);
  fmt::print("  {:<22} {:>9} {:>10} | per incoherent ray: {:>7} {:>11}\n", "", "coherent", "incoherent",
             "pieces", "unresolved");
  for (const auto& c : contenders)
    fmt::print("  {:<22} {:>8.1f}x {:>9.1f}x | {:>27.2f} {:>11.4f}\n", c->name, median(c->ratio[0]),
               median(c->ratio[1]), c->pieces, c->unresolved / static_cast<double>(sets[1].size()));
}

}  // namespace rondure::bench
