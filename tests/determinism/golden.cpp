#include "tests/determinism/golden.hpp"

#include "common/results/inspection.hpp"

namespace lukou::test {
namespace {

std::vector<std::string> paper_with(const std::vector<std::string>& settings) {
  std::vector<std::string> arguments = {"run", "paper", "--mode", "in-process", "--duration", "600", "--quiet"};
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  return arguments;
}

}  // namespace

// These hashes are the project's word that the same scenario gives the same bytes on every machine. They change only in
// a commit whose message says why the results change; a failing test is no reason to paste new ones.
const std::vector<GoldenRun>& golden_runs() {
  static const std::vector<GoldenRun> kRuns = {
      {.name = "the paper's scenario",
       .arguments = paper_with({"run.seed=1", "run.warmup_s=100"}),
       .golden = R"(car.csv 858ffa4f509f746846a980abdd657359f1c42daa4548eed06e66a6c043ef4176
directives.textproto e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855
road.csv c0b806129d049d97227714a011c7b4bbd17eabfb6b1600a494074f30419929ae
safety.csv 2b3332a43809300880e3a77b288e912e109cec2cc6e12285058b93fa5c7d728e
scenario.textproto 4ed87dc339c88508e85aef05f1bd481b5c558e12f2eb3ee0d14fa97c3289278a
stop.csv 7294999083b2b67081e2f6970e2aeda8fe33878f4426dae7838e52b017cf05e4
stop_time.csv 82e4e18ceb748921c529b8d3a865f3876a6c8f90ce74bbdc65183f04f5073f06
stops.csv d031e7ad74d206653cb79537fc7d562fc03692aabf92bc5ab6801064468c9d23
summary.json d56eae8bdf7b4d5e227141e43fa59dd5d894d188dade64cf3f54457ad71ed163
)"},
      {.name = "protected left turns under changing demand",
       .arguments = paper_with(
           {"run.seed=20260", "run.warmup_s=100", "signals.preset=PROTECTED_LEFT", "vehicles.equipped_ratio=0.3",
            "traffic.west={flow_series {from_s: 0 flow_veh_per_h: 400} flow_series {from_s: 200 flow_veh_per_h: 1300} "
            "flow_series {from_s: 450 flow_veh_per_h: 0}}",
            "traffic.south.flow_veh_per_h=900", "traffic.east.flow_veh_per_h=600",
            "traffic.north={flow_series {from_s: 60 flow_veh_per_h: 1000} shares {left: 3 center: 2 right: 1}}"}),
       .golden = R"(car.csv 9f1c1b64fdaffb1dd280e254f4d3e8bbddcc9bb95ecfa97478519104d0b3a026
directives.textproto e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855
road.csv 09276241b273bf621c8d9808c73ffafb8320ba43febc423aaa4408e72bb18745
safety.csv ffb928f522c2180de879a2bb135631b36418dd08fea6243f9de0be54a9d95690
scenario.textproto ae134bf7be3298fa59ba733e62f4b07f975974578519934379574feb2773c73b
stop.csv 78df05efbf88e514960c204a9b716095e7739bdb21609578ced4f28ef26744d7
stop_time.csv 24995a45268ca401a2251baa3b4e1ab902d6cd7f08a4a2e8bca74e0e4ff356f5
stops.csv 62935f667afce70f98da390bfc04d129a99af6bb111f9d01bf2fc384320563a3
summary.json 193cee52228c8e7fa11ff98ab7c867becf137a567535533defed233c1d38a778
)"},
      {.name = "lights on request, where nobody asks and lanes wait too long",
       .arguments = paper_with({"run.seed=3", "run.warmup_s=100", "signals.preset=PROTECTED_LEFT",
                                "signals.actuation.max_wait_s=60", "traffic.west.flow_veh_per_h=1000",
                                "traffic.south.flow_veh_per_h=600", "traffic.east.flow_veh_per_h=1000",
                                "traffic.north.flow_veh_per_h=600"}),
       .golden = R"(car.csv c1f4cab2400a7acfb2e50f2528964eec732045194f5363554b1dc576fba078a4
directives.textproto e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855
requests.csv fb2b13b49e4534bf0f2a0416f79badb8afd74de8a887464dc6986604004e932d
road.csv 665e945f1987261205520a3c5d61ec99f0cb4be0f857dff3e47f84b4005cde38
safety.csv 87c4292f9399701503eb3c3b569296a960cf86e93ebc2e80efbeeef00a724d8d
scenario.textproto 98f1df870621fb4f077878551d8f2cdb542d6764729ac4be2f6029762d9b52f3
stop.csv 4c35c0ef51dae2b23598a5b7446d0d62cb8c5cb2bca91df2ad905cf622863ca6
stop_time.csv 6692519d02c40fefeda93668cba007726ebdc505093d9ff549219d413d1ba617
stops.csv 93abbe6d3e0026e6ab94cb6b9b0b6f2231e93fce74a480e94ba3b6bc9abddaf7
summary.json a81248ece58b307b7b143c3f458402e6d90198e13e7daff6754502530d3ae36b
)"}};
  return kRuns;
}

std::string fingerprint(const GoldenRun& run, const std::vector<std::string>& environment, const std::string& program) {
  const TemporaryFolder folder;
  auto arguments = run.arguments;
  arguments.insert(arguments.end(), {"--out", folder / "result"});
  Program started(arguments, environment, program);
  const int code = started.wait();
  if (code != 0) return program + " ended with code " + std::to_string(code) + "\n" + started.out() + started.err();
  const auto files = results::result_files(folder / "result");
  if (!files) return files.error().text();
  std::string text;
  for (const auto& file : files.value()) text += file.name + " " + file.sha256 + "\n";
  return text;
}

}  // namespace lukou::test
