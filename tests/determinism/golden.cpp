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
       .golden = R"(car.csv 4a0b113e6c2a159170e5eb1d4bd4c8912be30682d2b463080ace0ed16f8182c3
directives.textproto e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855
road.csv c0b806129d049d97227714a011c7b4bbd17eabfb6b1600a494074f30419929ae
scenario.textproto e7a03c56c1e999a9e4600d30feabfe0d58d22359e42deb9315b1b1faa42d1fc3
stop.csv 7294999083b2b67081e2f6970e2aeda8fe33878f4426dae7838e52b017cf05e4
stop_time.csv 82e4e18ceb748921c529b8d3a865f3876a6c8f90ce74bbdc65183f04f5073f06
stops.csv d031e7ad74d206653cb79537fc7d562fc03692aabf92bc5ab6801064468c9d23
summary.json e89565e6e0a4be30f885a04b8e8e1fd81720000cfbb1273f1c97b3ababcdc17c
)"},
      {.name = "protected left turns under changing demand",
       .arguments = paper_with(
           {"run.seed=20260", "run.warmup_s=100", "signals.preset=PROTECTED_LEFT", "vehicles.equipped_ratio=0.3",
            "traffic.west={flow_series {from_s: 0 flow_veh_per_h: 400} flow_series {from_s: 200 flow_veh_per_h: 1300} "
            "flow_series {from_s: 450 flow_veh_per_h: 0}}",
            "traffic.south.flow_veh_per_h=900", "traffic.east.flow_veh_per_h=600",
            "traffic.north={flow_series {from_s: 60 flow_veh_per_h: 1000} shares {left: 3 center: 2 right: 1}}"}),
       .golden = R"(car.csv 3202f87d3967bfc0c841b8f3ef05078a8a36c82f9d688e119a4233eaa08730d3
directives.textproto e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855
road.csv 09276241b273bf621c8d9808c73ffafb8320ba43febc423aaa4408e72bb18745
scenario.textproto 631eca7951d4bc091b406797ba19a9ed9097e24bf1f13bd925731986f4bea7fa
stop.csv 78df05efbf88e514960c204a9b716095e7739bdb21609578ced4f28ef26744d7
stop_time.csv 24995a45268ca401a2251baa3b4e1ab902d6cd7f08a4a2e8bca74e0e4ff356f5
stops.csv 62935f667afce70f98da390bfc04d129a99af6bb111f9d01bf2fc384320563a3
summary.json 786b9c928ceb98559201c9835295d880bf50655b542e7a64f8a6e5cb2d48a7f2
)"},
      {.name = "lights on request, where nobody asks and lanes wait too long",
       .arguments = paper_with({"run.seed=3", "run.warmup_s=100", "signals.preset=PROTECTED_LEFT",
                                "signals.actuation.max_wait_s=60", "traffic.west.flow_veh_per_h=1000",
                                "traffic.south.flow_veh_per_h=600", "traffic.east.flow_veh_per_h=1000",
                                "traffic.north.flow_veh_per_h=600"}),
       .golden = R"(car.csv 342a24a99341a1641c8ff5924b255fd659cc40b19082210be088753385e11fb6
directives.textproto e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855
requests.csv fb2b13b49e4534bf0f2a0416f79badb8afd74de8a887464dc6986604004e932d
road.csv 665e945f1987261205520a3c5d61ec99f0cb4be0f857dff3e47f84b4005cde38
scenario.textproto bbf661ae305dbc4a951acbbae3fcd1e82379fbf5a60fe1928cfc4393b3e9384a
stop.csv 4c35c0ef51dae2b23598a5b7446d0d62cb8c5cb2bca91df2ad905cf622863ca6
stop_time.csv 6692519d02c40fefeda93668cba007726ebdc505093d9ff549219d413d1ba617
stops.csv 93abbe6d3e0026e6ab94cb6b9b0b6f2231e93fce74a480e94ba3b6bc9abddaf7
summary.json a17bf8f988ff14256b248d6f6004b2552e58589f79a19b3835008c59f7aaf0dd
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
