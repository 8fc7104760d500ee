#include "logging/study/report/drive_records.hpp"

#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/opendrive_reader.hpp"

namespace septet::logging {

std::vector<std::optional<double>> speed_limits_of(const SessionInfo& info, const std::vector<Sample>& samples) {
  std::vector<std::optional<double>> limits_mps(samples.size());
  const auto file = std::ranges::find(info.files, "road", &SourceFile::role);
  if (file == info.files.end()) return limits_mps;
  const auto roads = road::read_opendrive(file->content, file->name);
  if (!roads) return limits_mps;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    if (sample.lane == 0 || sample.road >= roads->roads.size() || !std::isfinite(sample.road_s_m)) continue;
    const double limit_mps = road::speed_limit_mps(*roads, {sample.road, sample.lane, sample.road_s_m, 0.0});
    if (limit_mps > 0.0) limits_mps[i] = limit_mps;
  }
  return limits_mps;
}

std::optional<double> car_width_of(const SessionInfo& info) {
  const auto file = std::ranges::find(info.files, "vehicle", &SourceFile::role);
  if (file == info.files.end()) return std::nullopt;
  const auto car = vehicle::read_vehicle(file->content, file->name);
  return car && car->body.width_m > 0.0 ? std::optional(car->body.width_m) : std::nullopt;
}

Expected<DriveRecords> read_drive_records(const SessionReader& reader) {
  auto samples = reader.samples();
  if (!samples) return tl::unexpected(samples.error());
  auto inputs = reader.inputs();
  if (!inputs) return tl::unexpected(inputs.error());
  auto events = reader.events();
  if (!events) return tl::unexpected(events.error());
  const ImpossibleNumbers impossible = leave_out_impossible(*samples, *inputs);
  DriveRecords records{
      std::move(*samples), std::move(*inputs), std::move(*events), {}, reader.info().ticks_per_second, {}, {},
      impossible};
  records.speed_limits_mps = speed_limits_of(reader.info(), records.samples);
  records.car_width_m = car_width_of(reader.info());
  const auto& files = reader.info().files;
  if (const auto file = std::ranges::find(files, "rig", &SourceFile::role); file != files.end())
    if (const auto rig = rig::read_rig(file->content, file->name)) records.glance_areas = glance_areas(*rig);
  return records;
}

}  // namespace septet::logging
