#include <gtest/gtest.h>

#include "common/run_log/mcap_reader.hpp"
#include "common/run_log/mcap_writer.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::run_log {
namespace {

class Mcap : public results::InTestFolder {
 protected:
  /// Three chunks of two messages each on one channel; message n says "n" and is of time n.
  void write_file(bool with_end = true) {
    auto writer = McapWriter::create(folder() / "a.mcap", "test");
    ASSERT_TRUE(writer);
    McapWriter& file = writer.value();
    const std::uint16_t channel = file.add_channel("/topic", "a.Type", "descriptors");
    EXPECT_EQ(channel, 1U);
    file.add_metadata({.name = "facts", .entries = {{"key", "value"}, {"more", "\n\"'"}}});
    for (std::uint32_t n = 0; n < 6; ++n) {
      file.add(channel, n, n, std::to_string(n));
      if (n % 2 == 1) {
        ASSERT_TRUE(file.end_chunk());
      }
    }
    if (!with_end) return;
    ASSERT_TRUE(file.close());
    hash_ = file.sha256();
  }
  [[nodiscard]] std::vector<std::string> messages(const McapReader& reader) const {
    std::vector<std::string> found;
    for (std::size_t i = 0; i < reader.index().chunks.size(); ++i) {
      const auto chunk = reader.chunk(i);
      EXPECT_TRUE(chunk.ok());
      std::string_view rest = chunk.value();
      while (const auto message = McapReader::take_message(rest)) {
        EXPECT_EQ(std::to_string(message->log_time_ns), message->data);
        EXPECT_EQ(message->sequence, message->log_time_ns);
        found.emplace_back(message->data);
      }
    }
    return found;
  }
  std::string hash_;
};

const std::vector<std::string> kAll = {"0", "1", "2", "3", "4", "5"};

TEST_F(Mcap, GivesBackWhatWasWritten) {
  write_file();
  const auto reader = McapReader::open(folder() / "a.mcap");
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_TRUE(reader.value().finished());
  EXPECT_EQ(messages(reader.value()), kAll);
  EXPECT_EQ(reader.value().topics().at(1), "/topic");
  EXPECT_EQ(reader.value().index().messages.at(1), 6U);
  const auto facts = reader.value().metadata("facts");
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->entries.at("more"), "\n\"'");
  EXPECT_FALSE(reader.value().metadata("others"));
  EXPECT_EQ(hash_, sha256_hex(content("a.mcap")));
}

TEST_F(Mcap, TheSameCallsGiveTheSameBytes) {
  write_file();
  const std::string first = content("a.mcap");
  std::filesystem::remove(folder() / "a.mcap");
  write_file();
  EXPECT_EQ(content("a.mcap"), first);
}

TEST_F(Mcap, WithoutItsEndIsReadByGoingThroughIt) {
  write_file(false);
  const auto reader = McapReader::open(folder() / "a.mcap");
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_FALSE(reader.value().finished());
  EXPECT_EQ(messages(reader.value()), kAll);
  EXPECT_EQ(reader.value().index().messages.at(1), 6U);
  EXPECT_EQ(reader.value().torn_bytes(), 0U);
}

TEST_F(Mcap, CutAnywhereStillGivesEveryWholeChunk) {
  write_file();
  const std::string whole = content("a.mcap");
  const McapIndex index = McapReader::open(folder() / "a.mcap").value().index();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write("cut.mcap", whole.substr(0, size));
    const auto reader = McapReader::open(folder() / "cut.mcap");
    if (size < index.chunks.front().offset) continue;  // not even the head is whole; no crash is all that is asked
    ASSERT_TRUE(reader) << size << ": " << reader.error().text();
    std::vector<std::string> expected;
    for (const ChunkIndex& chunk : index.chunks) {
      if (chunk.offset + chunk.length > size) break;
      expected.push_back(kAll[expected.size()]);
      expected.push_back(kAll[expected.size()]);
    }
    EXPECT_EQ(messages(reader.value()), expected) << size;
  }
}

TEST_F(Mcap, SaysWhereBytesHaveChanged) {
  write_file();
  std::string bytes = content("a.mcap");
  const McapIndex index = McapReader::open(folder() / "a.mcap").value().index();
  const ChunkIndex& second = index.chunks[1];
  bytes[second.offset + second.length - 1] ^= 1;
  write("changed.mcap", bytes);
  const auto reader = McapReader::open(folder() / "changed.mcap");
  ASSERT_TRUE(reader);
  EXPECT_TRUE(reader.value().chunk(0));
  const auto broken = reader.value().chunk(1);
  ASSERT_FALSE(broken);
  EXPECT_TRUE(broken.error().what.starts_with("the chunk at byte " + std::to_string(second.offset)))
      << broken.error().text();
}

TEST_F(Mcap, RefusesWhatIsNoMcapFile) {
  write("car.csv", "vehicle,lane\n");
  EXPECT_EQ(McapReader::open(folder() / "car.csv").error().what, "is no MCAP file: it does not begin as one");
  EXPECT_FALSE(McapReader::open(folder() / "missing.mcap"));
  EXPECT_FALSE(McapReader::open(folder()));
}

TEST_F(Mcap, DoesNotOverwriteAFile) {
  write("a.mcap", "mine");
  EXPECT_FALSE(McapWriter::create(folder() / "a.mcap", "test"));
  EXPECT_EQ(content("a.mcap"), "mine");
}

}  // namespace
}  // namespace lukou::run_log
