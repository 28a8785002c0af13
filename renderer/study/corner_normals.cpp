#include "renderer/study/corner_normals.h"

#include <fmt/format.h>

#include <set>

#include "renderer/film/image.h"
#include "renderer/render/interrupt.h"
#include "renderer/render/progress.h"
#include "renderer/study/gnuplot.h"

namespace rondure {
namespace {

// From files of an earlier run if they are of the same subject.
CornerTables kept_corners(const Subject& subject, const Registry& registry, const StudyFolder& folder,
                          const StudyOptions& options) {
  const std::string key = fmt::format("{} quick {}", subject.object, options.quick);
  std::optional<CornerTables> fresh;
  const auto measured = [&]() -> const CornerTables& {
    if (!fresh) fresh = measure_corners(subject, registry, options.quick);
    return *fresh;
  };
  const std::string stem = "parts/" + subject.name;
  CornerTables tables;
  tables.families =
      Table(folder.kept(stem + "-families.csv", key, [&] { return measured().families.text(); }));
  tables.sites = Table(folder.kept(stem + "-sites.csv", key, [&] { return measured().sites.text(); }));
  tables.walks = Table(folder.kept(stem + "-walks.csv", key, [&] { return measured().walks.text(); }));
  return tables;
}

}  // namespace

void study_corner_normals(const StudyOptions& options, const Registry& registry) {
  std::vector<Subject> chosen;
  for (const Subject& subject :
       options.scene.empty() ? subjects_named(options.families) : subjects_of_scene(options.scene, registry))
    chosen.push_back(turned(subject));
  require_gnuplot();
  require_image_module();
  const StudyFolder folder(options.output);
  const StudyFolder parts(folder.path("parts"));
  const InterruptGuard guard;
  CornerTables all;
  std::vector<CloseUps> close_ups;
  {
    Progress progress("singular points", chosen.size(), progress_style(options.quiet));
    for (const Subject& subject : chosen) {
      const CornerTables tables = kept_corners(subject, registry, folder, options);
      all.families.append(tables.families);
      all.sites.append(tables.sites);
      all.walks.append(tables.walks);
      progress.advance(1);
      stop_if_interrupted(progress, folder);
    }
  }
  const Table slopes = corner_slopes(all.walks);
  const Table& sites = all.sites;
  folder.write("families.csv", all.families.text());
  folder.write("sites.csv", sites.text());
  folder.write("walks.csv", all.walks.text());
  folder.write("slopes.csv", slopes.text());

  // The first site of each group.
  std::vector<std::pair<const Subject*, std::size_t>> firsts;
  std::set<std::string> seen;
  for (std::size_t row = 0; row < sites.size(); ++row) {
    for (const Subject& subject : chosen) {
      if (subject.name != sites.at(row, "family")) continue;
      if (seen.insert(subject.name + "/" + sites.at(row, "group")).second) firsts.emplace_back(&subject, row);
    }
  }
  {
    Progress progress("close-ups", firsts.size() * close_ups_a_site(options), progress_style(options.quiet));
    const auto done = [&] {
      progress.advance(1);
      stop_if_interrupted(progress, folder);
    };
    for (const auto& [subject, row] : firsts)
      close_ups.push_back(
          take_close_ups(*subject, registry, sites, row, sites.at(row, "group"), folder, options, done));
  }
  folder.write("index.html", corner_page(all, slopes, close_ups, folder, options));
}

}  // namespace rondure
