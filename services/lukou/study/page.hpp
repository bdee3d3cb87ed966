#pragma once

#include <string>
#include <vector>

#include "services/lukou/study/pictures.hpp"
#include "services/lukou/study/study_folder.hpp"

namespace lukou::studies {

/// report.html: what was run, what it says, how far it can be believed, with all pictures inside; no scripts, nothing
/// from elsewhere.
std::string page_of(const StudyFolder& folder, const Outcome& outcome, const std::vector<Picture>& pictures);

}  // namespace lukou::studies
