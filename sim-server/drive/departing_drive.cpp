#include "sim-server/drive/departing_drive.hpp"

#include <memory>
#include <span>
#include <string>
#include <utility>

#include "engine/core/check.hpp"
#include "engine/core/hash.hpp"
#include "engine/simulation/deviation_text.hpp"

namespace septet::server {

LoadedDrive departing_drive(LoadedDrive drive, const simulation::MotionDeviation& deviation) {
  SEPTET_CHECK(drive.model->motion, "a drive without a table");
  auto model = std::make_shared<simulation::Model>(*drive.model);
  model->motion = std::make_shared<const simulation::GivenMotion>(simulation::deviating(*model->motion, deviation));
  const std::string departure = simulation::deviation_text(deviation);
  StateHash sources;
  sources.add(model->sources_hash);
  sources.add_bytes(std::as_bytes(std::span(departure)));
  model->sources_hash = sources.value();
  drive.model = std::move(model);
  return drive;
}

}  // namespace septet::server
