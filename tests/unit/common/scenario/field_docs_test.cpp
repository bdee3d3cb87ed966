#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"

namespace lukou::scenario {
namespace {

const FieldDoc* doc_of(const std::vector<FieldDoc>& docs, const std::string& path) {
  const auto found = std::find_if(docs.begin(), docs.end(), [&](const FieldDoc& doc) { return doc.path == path; });
  return found == docs.end() ? nullptr : &*found;
}

TEST(FieldDocs, SayWhatTheSchemaSays) {
  const auto docs = field_docs();
  const FieldDoc* flow = doc_of(docs, "traffic.north.flow_veh_per_h");
  ASSERT_NE(flow, nullptr);
  EXPECT_EQ(flow->type, "number");
  EXPECT_EQ(flow->unit, "veh/h");
  EXPECT_EQ(flow->min, 0.0);
  EXPECT_EQ(flow->max, 10800.0);
  EXPECT_EQ(flow->fallback, "1800");
  EXPECT_TRUE(flow->live);
  EXPECT_FALSE(flow->on_step_grid);
  const FieldDoc* policy = doc_of(docs, "run.on_rsu_loss");
  ASSERT_NE(policy, nullptr);
  EXPECT_EQ(policy->type, "ABORT | CONTINUE | WAIT");
  ASSERT_NE(doc_of(docs, "run.duration_s"), nullptr);
  EXPECT_TRUE(doc_of(docs, "run.duration_s")->on_step_grid);
  EXPECT_NE(doc_of(docs, "rsus[].arrive_on_green.headway_s"), nullptr);
  EXPECT_NE(doc_of(docs, "signals.plan"), nullptr);
  EXPECT_EQ(doc_of(docs, "traffic.west"), nullptr) << "a message that only groups its fields";
}

TEST(FieldDocs, OfEveryNumberHaveARangeAndASource) {
  for (const FieldDoc& doc : field_docs()) {
    if (doc.type != "number") continue;
    EXPECT_TRUE(doc.min.has_value() && doc.max.has_value()) << doc.path;
    EXPECT_FALSE(doc.source.empty()) << doc.path;
  }
}

TEST(FieldDocs, MarkWhatMayChangeLive) {
  for (const std::string& path : live_fields()) {
    const auto docs = field_docs();
    ASSERT_NE(doc_of(docs, path), nullptr) << path;
    EXPECT_TRUE(doc_of(docs, path)->live);
  }
}

}  // namespace
}  // namespace lukou::scenario
