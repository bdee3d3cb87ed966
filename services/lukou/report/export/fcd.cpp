// Source of the format: SUMO's documentation, Simulation/Output/FCDOutput; schema fcd_file.xsd.

#include <string>

#include "common/core/math.hpp"
#include "services/lukou/report/export/recorded_cars.hpp"
#include "services/lukou/report/export/trajectory_files.hpp"
#include "services/lukou/report/output_file.hpp"
#include "services/lukou/report/words.hpp"

namespace lukou::report {
namespace {

/// SUMO counts lanes from the right.
std::string sumo_lane(const RecordedCar& car) {
  const std::string_view lane = name(car.lane);
  if (car.past_line_m > 0.0) return std::string(lane) + "_exit_0";
  const int from_the_right = kLanesPerApproach - 1 - static_cast<int>(turn_of(car.lane));
  return std::string(lane.substr(0, 1)) + "_" + std::to_string(from_the_right);
}

std::string vehicle_element(const RecordedCar& car) {
  const double along_m = car.past_line_m > 0.0 ? car.past_line_m : car.position_m;
  return "        <vehicle id=\"" + std::to_string(car.vehicle) + "\" x=\"" + fixed(car.front.x_m, 3) + "\" y=\"" +
         fixed(car.front.y_m, 3) + "\" angle=\"" + fixed(car.front.heading_rad * 180.0 / math::kPi, 2) + "\" type=\"" +
         (car.equipped ? "equipped" : "unequipped") + "\" speed=\"" + fixed(car.speed_mps, 3) + "\" pos=\"" +
         fixed(along_m, 3) + "\" lane=\"" + sumo_lane(car) + "\" slope=\"0.00\" acceleration=\"" +
         fixed(car.acceleration_mps2, 3) + "\"/>\n";
}

}  // namespace

Expected<Done> write_fcd(const Result& result, Step period, const std::filesystem::path& file) {
  auto output = OutputFile::create(file);
  if (!output) return output.error();
  auto begun = output.value().write(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fcd-export xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:noNamespaceSchemaLocation=\"http://sumo.dlr.de/xsd/fcd_file.xsd\">\n");
  if (!begun) return begun;
  const RoadLengths road = road_facts(result).road;
  auto told = for_each_instant(result, period, [&](Step step, const TrafficBatch& batch) {
    std::string text = "    <timestep time=\"" + fixed(time_s(step), 2) + "\">\n";
    for (std::size_t i = 0; i < batch.vehicle.size(); ++i) text += vehicle_element(recorded_car(batch, i, road));
    return output.value().write(text + "    </timestep>\n");
  });
  if (!told) return told;
  if (auto ended = output.value().write("</fcd-export>\n"); !ended) return ended;
  return output.value().finish();
}

}  // namespace lukou::report
