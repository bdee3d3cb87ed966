#pragma once

#include "common/lockstep/messages.hpp"

namespace lukou {

/// A well-formed view in which no car has come yet.
inline View empty_road() {
  View view;
  FigureColumns& f = view.figures;
  for (auto* column : {&f.arrived, &f.waiting, &f.in_system, &f.left, &f.standing, &f.stops}) column->resize(3);
  for (auto* column :
       {&f.throughput_veh_per_h, &f.stops_per_vehicle, &f.stop_time_s, &f.mean_stop_time_s, &f.mean_delay_s}) {
    column->resize(3);
  }
  view.queue.resize(12);
  view.arrived.resize(4);
  view.waiting.resize(4);
  view.advice.resize(23);
  return view;
}

}  // namespace lukou
