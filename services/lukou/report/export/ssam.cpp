// Source of the format: FHWA, SSAM File Format v1.04.

#include <bit>
#include <cmath>
#include <string>

#include "common/core/math.hpp"
#include "services/lukou/report/export/recorded_cars.hpp"
#include "services/lukou/report/export/trajectory_files.hpp"
#include "services/lukou/report/output_file.hpp"

namespace lukou::report {
namespace {

/// Little endian numbers one after the other.
class Bytes {
 public:
  void byte(int value) { bytes_ += static_cast<char>(value); }
  void number(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>((value >> shift) & 0xffU);
  }
  void real(double value) { number(std::bit_cast<std::uint32_t>(static_cast<float>(value))); }
  [[nodiscard]] const std::string& text() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

enum Record { kFormat = 0, kDimensions = 1, kTimestep = 2, kVehicle = 3 };

void put_head(Bytes& bytes, double reach_m) {
  bytes.byte(kFormat);
  bytes.byte('L');
  bytes.real(1.04);
  const auto edge = static_cast<std::int32_t>(std::ceil(reach_m));
  bytes.byte(kDimensions);
  bytes.byte(1);  // metric
  bytes.real(1.0);
  for (const std::int32_t side : {-edge, -edge, edge, edge}) bytes.number(static_cast<std::uint32_t>(side));
}

/// The middle of the car's back. On the curve it lies on the path; before the entrance straight behind the front.
Pose back_of(const RecordedCar& car, const RoadFacts& facts) {
  return pose_on_path(facts.road, car.lane, car.position_m - facts.vehicle_length_m);
}

void put_vehicle(Bytes& bytes, const RecordedCar& car, const RoadFacts& facts) {
  const bool behind_line = car.past_line_m > 0.0;
  const Pose back = back_of(car, facts);
  bytes.byte(kVehicle);
  bytes.number(car.vehicle);
  bytes.number(static_cast<std::uint32_t>(behind_line ? 11 + index(car.lane) : 1 + index(approach_of(car.lane))));
  bytes.byte(behind_line ? 1 : 1 + static_cast<int>(turn_of(car.lane)));
  for (const double value : {car.front.x_m, car.front.y_m, back.x_m, back.y_m, facts.vehicle_length_m,
                             facts.vehicle_width_m, car.speed_mps, car.acceleration_mps2}) {
    bytes.real(value);
  }
}

}  // namespace

Expected<Done> write_ssam(const Result& result, Step period, const std::filesystem::path& file) {
  auto output = OutputFile::create(file);
  if (!output) return output.error();
  const RoadFacts facts = road_facts(result);
  Bytes bytes;
  put_head(bytes, kStopLineOffset_m + std::max(facts.road.approach_m + facts.vehicle_length_m, facts.road.exit_m));
  auto told = for_each_instant(result, period, [&](Step step, const TrafficBatch& batch) {
    bytes.byte(kTimestep);
    bytes.real(time_s(step));
    for (std::size_t i = 0; i < batch.vehicle.size(); ++i)
      put_vehicle(bytes, recorded_car(batch, i, facts.road), facts);
    auto written = output.value().write(bytes.text());
    bytes.clear();
    return written;
  });
  if (!told) return told;
  return output.value().finish();
}

}  // namespace lukou::report
