#pragma once

#include <optional>

#include "services/lukou/report/export/sheets.hpp"
#include "services/lukou/report/result.hpp"

namespace lukou::report {

/// What of a record is wanted.
struct ExportWish {
  bool cars = false;
  bool trajectories = false;
  bool signals = false;
  bool messages = false;
  bool advice = false;
  std::optional<Step> period;  ///< between two pictures of the cars; absent: as recorded
};

/// All that the record holds. Errors: there is no run log.
Expected<ExportWish> everything(const Result& result);

/// Steps between two pictures of the cars. Errors: the record does not hold what is wanted.
Expected<Step> check_wish(const Result& result, const ExportWish& wish);

/// Gives the rows of the sheets that are wanted, and the parameters of the run, to a sink. Requires a wish that has
/// been checked, and its period. Errors: a record that is broken; what the sink says.
Expected<Done> give_sheets(const Result& result, const ExportWish& wish, Step period, SheetSink& sink);

}  // namespace lukou::report
