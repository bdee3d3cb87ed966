#include "services/lukou/study/sweep.hpp"

#include <set>

#include "common/results/result_folder.hpp"
#include "services/lukou/study/page.hpp"

namespace lukou::studies {

Expected<int> make_missing_runs(const StudyFolder& folder, const MakeRuns& make) {
  std::set<RunKey> tried;
  while (true) {
    const auto gathered = gather(folder);
    if (!gathered) return gathered.error();
    // A run that failed in this session is not tried for ever.
    std::vector<RunKey> runs = missing_runs(gathered.value());
    std::erase_if(runs, [&](const RunKey& run) { return !tried.insert(run).second; });
    if (runs.empty()) return 0;
    const auto made = make(folder, runs);
    if (!made || made.value() != 0) return made;
  }
}

Expected<Outcome> write_report(const StudyFolder& folder) {
  auto outcome = outcome_of(folder);
  if (!outcome) return outcome;
  if (auto done = write_database(folder, outcome.value()); !done) return done.error();
  if (auto done = write_tables(folder, outcome.value()); !done) return done.error();
  const std::vector<Picture> pictures = pictures_of(folder.study(), folder.plan(), outcome.value());
  const auto figures = folder.path() / "figures";
  std::error_code code;
  std::filesystem::remove_all(figures, code);
  std::filesystem::create_directories(figures, code);
  for (const Picture& picture : pictures) {
    if (auto done = results::write_file(figures / (picture.name + ".svg"), picture.svg); !done) return done.error();
  }
  const std::string page = page_of(folder, outcome.value(), pictures);
  if (auto done = results::write_file(folder.path() / "report.html", page); !done) return done.error();
  return outcome;
}

}  // namespace lukou::studies
