#include "engine/physics/vehicle/read_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/document/toml_table.hpp"
#include "engine/physics/vehicle/wheel_damage.hpp"

namespace septet::vehicle {
namespace {

/// Reads the entries of one file, remembers the first error, and knows which entries were never read.
class Entries {
 public:
  Entries(const toml::table& root, std::string_view name) : root_(root), name_(name) {}

  const std::optional<Error>& error() const { return error_; }
  bool has(std::string_view section) const { return !!root_.at_path(section); }

  void number(std::string_view path, double& out, double low, double high) {
    const toml::table* entry = find(path);
    if (!entry) return;
    const auto value = (*entry)["value"].value<double>();
    if (!value || !std::isfinite(*value)) return fail("has no number", path, "write { value = 1.0, source = \"…\" }");
    if (*value < low || *value > high)
      return fail(fmt::format("is {}, outside {} to {}", *value, low, high), path, "correct the value or its unit");
    out = *value;
  }
  void whole(std::string_view path, int& out, int low, int high) {
    double value = out;
    number(path, value, low, high);
    out = static_cast<int>(value);
  }
  void flag(std::string_view path, bool& out) {
    const toml::table* entry = find(path);
    if (!entry) return;
    const auto value = (*entry)["value"].value<bool>();
    if (!value) return fail("is neither true nor false", path, "write { value = true, source = \"…\" }");
    out = *value;
  }
  std::string word(std::string_view path) {
    seen_.insert(std::string(path));
    const auto value = root_.at_path(path).value<std::string>();
    if (!value) fail("is missing", path, "give one of the words in vehicles/README.md");
    return value.value_or("");
  }
  /// Points whose y lies in a range that holds all existing cars.
  void table(std::string_view path, Table& out, double low, double high) {
    const toml::table* entry = find(path);
    if (!entry) return;
    const toml::array* xs = (*entry)["x"].as_array();
    const toml::array* ys = (*entry)["y"].as_array();
    if (!xs || !ys || xs->size() != ys->size() || xs->empty() || xs->size() > Table::capacity)
      return fail("is not a table of 1 to 16 points", path,
                  "write { x = [0, 1], y = [2, 3], source = \"…\" } with as many x as y");
    out.count = xs->size();
    for (std::size_t i = 0; i < out.count; ++i) {
      const auto x = (*xs)[i].value<double>(), y = (*ys)[i].value<double>();
      if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y))
        return fail(fmt::format("point {} is not a number", i + 1), path, "give numbers only");
      if (std::abs(*x) > 1e4)
        return fail(fmt::format("x is {} at point {}, outside ±10000", *x, i + 1), path,
                    "correct the value or its unit");
      if (*y < low || *y > high)
        return fail(fmt::format("is {} at point {}, outside {} to {}", *y, i + 1, low, high), path,
                    "correct the value or its unit");
      out.x[i] = *x;
      out.y[i] = *y;
      if (i > 0 && out.x[i] <= out.x[i - 1])
        return fail(fmt::format("x does not increase at point {}", i + 1), path, "sort the points by x");
    }
  }
  void list(std::string_view path, std::array<double, PowertrainParameters::most_gears>& out, int& count) {
    Table gears;
    table(path, gears, 0.1, 30);
    count = static_cast<int>(std::min(gears.count, out.size()));
    for (int i = 0; i < count; ++i) out[i] = gears.y[i];
  }
  void fail(std::string what, std::string_view path, std::string remedy) {
    if (!error_)
      error_ = Error{std::move(what), fmt::format("{}, {}", document::place_of(nearest(path), name_), path),
                     std::move(remedy)};
  }
  /// Every entry with a value or points that was never read is a misspelling.
  void refuse_unknown() { refuse_unknown(root_, ""); }

 private:
  const toml::table* find(std::string_view path) {
    seen_.insert(std::string(path));
    const toml::table* entry = root_.at_path(path).as_table();
    if (!entry) {
      fail("is missing", path, "add it with its source; vehicles/README.md lists the entries");
      return nullptr;
    }
    const auto source = (*entry)["source"].value<std::string>().value_or("");
    bool good = false;
    for (const char* kind : {"sourced: ", "derived: ", "assumed: "}) good |= source.starts_with(kind);
    if (!good || source.size() < 12) {
      fail("has no source", path, "add source = \"sourced: …\", \"derived: …\" or \"assumed: …\"");
      return nullptr;
    }
    return entry;
  }
  /// The entry, or where it is missing the innermost table to which it belongs.
  const toml::node& nearest(std::string_view path) const {
    for (;;) {
      if (const auto found = root_.at_path(path)) return *found.node();
      const auto dot = path.rfind('.');
      if (dot == path.npos) return root_;
      path = path.substr(0, dot);
    }
  }
  void refuse_unknown(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string path = prefix.empty() ? std::string(key) : prefix + "." + std::string(key);
      const toml::table* below = node.as_table();
      const bool entry = !below || below->contains("value") || below->contains("x");
      if (!entry)
        refuse_unknown(*below, path);
      else if (!seen_.contains(path) && path != "name" && path != "description")
        fail("is not known", path, "remove it or correct its spelling");
    }
  }

  const toml::table& root_;
  std::string name_;
  std::set<std::string> seen_;
  std::optional<Error> error_;
};

void read_body(Entries& in, BodyParameters& body) {
  in.number("body.mass_kg", body.mass_kg, 300, 5000);
  in.number("body.wheelbase_m", body.wheelbase_m, 1.5, 6);
  in.number("body.mass_centre_x_m", body.mass_centre_x_m, 0.2, 5);
  in.number("body.mass_centre_z_m", body.mass_centre_z_m, 0.2, 2);
  in.number("body.roll_inertia_kgm2", body.inertia_kgm2.x, 50, 20000);
  in.number("body.pitch_inertia_kgm2", body.inertia_kgm2.y, 200, 50000);
  in.number("body.yaw_inertia_kgm2", body.inertia_kgm2.z, 200, 50000);
  in.number("body.length_m", body.length_m, 2, 12);
  in.number("body.width_m", body.width_m, 1, 3);
  in.number("body.height_m", body.height_m, 1, 4.5);
  in.number("body.rear_overhang_m", body.rear_overhang_m, 0, 4);
  in.number("body.drag_area_m2", body.drag_area_m2, 0, 10);
  in.number("body.front_lift_area_m2", body.lift_area_m2[0], -2, 2);
  in.number("body.rear_lift_area_m2", body.lift_area_m2[1], -2, 2);
}

void read_suspension(Entries& in, const std::string& axle, SuspensionParameters& out) {
  const auto at = [&](const char* entry) { return "suspension." + axle + "." + entry; };
  in.number(at("track_m"), out.track_m, 0.8, 3);
  in.flag(at("rigid_axle"), out.rigid_axle);
  in.number(at("unsprung_mass_kg"), out.unsprung_mass_kg, 10, 500);
  in.number(at("wheel_inertia_kgm2"), out.wheel_inertia_kgm2, 0.3, 50);
  in.table(at("spring_force_n"), out.spring_force_n, -2e5, 2e5);
  in.table(at("damper_force_n"), out.damper_force_n, -2e5, 2e5);
  in.number(at("anti_roll_npm"), out.anti_roll_npm, -1e5, 2e5);
  in.table(at("camber_rad"), out.camber_rad, -1, 1);
  in.table(at("toe_rad"), out.toe_rad, -1, 1);
  in.table(at("contact_lateral_slope"), out.contact_lateral_slope, -2, 2);
  in.table(at("contact_longitudinal_slope"), out.contact_longitudinal_slope, -2, 2);
  in.table(at("centre_lateral_slope"), out.centre_lateral_slope, -2, 2);
  in.table(at("centre_longitudinal_slope"), out.centre_longitudinal_slope, -2, 2);
  in.number(at("toe_out_by_lateral_force_radpn"), out.toe_out_by_lateral_force_radpn, -1e-5, 1e-5);
  in.number(at("steer_by_aligning_torque_radpnm"), out.steer_by_aligning_torque_radpnm, 0, 1e-3);
  in.number(at("contact_by_lateral_force_mpn"), out.contact_by_lateral_force_mpn, 0, 1e-4);
  in.number(at("camber_by_lateral_force_radpn"), out.camber_by_lateral_force_radpn, -1e-5, 1e-5);
}

void read_curve(Entries& in, const std::string& path, SlipCurve& curve) {
  in.number(path + ".slope_n", curve.slope_n, 1e3, 1e7);
  in.number(path + ".peak_slip", curve.peak_slip, 0.01, 1);
  in.number(path + ".peak_force_n", curve.peak_force_n, 100, 1e6);
  in.number(path + ".sliding_slip", curve.sliding_slip, 0.02, 5);
  in.number(path + ".sliding_force_n", curve.sliding_force_n, 100, 1e6);
  // Otherwise the rational rise has a pole or overshoots its own maximum.
  if (curve.slope_n * curve.peak_slip < 1.5 * curve.peak_force_n)
    in.fail("rises too slowly to its peak", path, "keep slope × peak slip at 1.5 times the peak force or more");
  if (curve.sliding_slip <= curve.peak_slip)
    in.fail("slides before its peak", path, "give a sliding slip beyond the peak slip");
}

void read_load_sensitive(Entries& in, LoadSensitiveTyre& tyre) {
  in.number("tyre.nominal_load_n", tyre.nominal_load_n, 500, 50000);
  read_curve(in, "tyre.longitudinal_nominal", tyre.longitudinal_nominal);
  read_curve(in, "tyre.longitudinal_double", tyre.longitudinal_double);
  read_curve(in, "tyre.lateral_nominal", tyre.lateral_nominal);
  read_curve(in, "tyre.lateral_double", tyre.lateral_double);
  in.number("tyre.trail_over_length", tyre.trail_over_length, 0, 0.5);
  in.number("tyre.trail_zero_slip", tyre.trail_zero_slip, 0.02, 1);
  in.number("tyre.camber_slip", tyre.camber_slip, 0, 1);
  in.number("tyre.longitudinal_stiffness_npm", tyre.longitudinal_stiffness_npm, 1e4, 2e6);
  in.number("tyre.lateral_stiffness_npm", tyre.lateral_stiffness_npm, 1e4, 2e6);
  in.number("tyre.longitudinal_damping_nspm", tyre.longitudinal_damping_nspm, 0, 5e3);
  in.number("tyre.lateral_damping_nspm", tyre.lateral_damping_nspm, 0, 5e3);
}

void read_published(Entries& in, PublishedTyre& p) {
  const std::pair<const char*, double*> coefficients[] = {
      {"p_cx1", &p.p_cx1}, {"p_dx1", &p.p_dx1}, {"p_dx3", &p.p_dx3}, {"p_ex1", &p.p_ex1}, {"p_kx1", &p.p_kx1},
      {"p_hx1", &p.p_hx1}, {"p_vx1", &p.p_vx1}, {"r_bx1", &p.r_bx1}, {"r_bx2", &p.r_bx2}, {"r_cx1", &p.r_cx1},
      {"r_ex1", &p.r_ex1}, {"r_hx1", &p.r_hx1}, {"p_cy1", &p.p_cy1}, {"p_dy1", &p.p_dy1}, {"p_dy3", &p.p_dy3},
      {"p_ey1", &p.p_ey1}, {"p_ky1", &p.p_ky1}, {"p_hy1", &p.p_hy1}, {"p_hy3", &p.p_hy3}, {"p_vy1", &p.p_vy1},
      {"p_vy3", &p.p_vy3}, {"r_by1", &p.r_by1}, {"r_by2", &p.r_by2}, {"r_by3", &p.r_by3}, {"r_cy1", &p.r_cy1},
      {"r_ey1", &p.r_ey1}, {"r_hy1", &p.r_hy1}, {"r_vy1", &p.r_vy1}, {"r_vy3", &p.r_vy3}, {"r_vy4", &p.r_vy4},
      {"r_vy5", &p.r_vy5}, {"r_vy6", &p.r_vy6}};
  for (const auto& [name, value] : coefficients) in.number(std::string("tyre.") + name, *value, -100, 100);
  in.number("tyre.relaxation_length_m", p.relaxation_length_m, 0.04, 2);
}

void read_tyre(Entries& in, TyreParameters& tyre) {
  const std::string model = in.word("tyre.model");
  tyre.published = model == "published";
  if (tyre.published)
    read_published(in, tyre.magic_formula);
  else if (model == "load-sensitive")
    read_load_sensitive(in, tyre.load_sensitive);
  else
    in.fail("is not a tyre model", "tyre.model", "write \"load-sensitive\" or \"published\"");
  in.number("tyre.reference_friction", tyre.reference_friction, 0.05, 2);
  in.number("tyre.radius_m", tyre.radius_m, 0.15, 1);
  in.number("tyre.rim_radius_m", tyre.rim_radius_m, 0.1, 0.9);
  if (sidewall_m(tyre) < 0.02)
    in.fail("leaves the tyre no sidewall", "tyre.rim_radius_m", "keep it 40 mm below tyre.radius_m or more");
  in.number("tyre.vertical_stiffness_npm", tyre.vertical_stiffness_npm, 5e4, 2e6);
  in.number("tyre.vertical_damping_nspm", tyre.vertical_damping_nspm, 0, 5e3);
  in.number("tyre.rolling_resistance", tyre.rolling_resistance, 0, 0.1);
  in.number("tyre.rolling_resistance_s2pm2", tyre.rolling_resistance_s2pm2, 0, 1e-4);
}

void read_steering(Entries& in, SteeringParameters& steering) {
  in.number("steering.ratio", steering.ratio, 1, 40);
  in.number("steering.lock_rad", steering.lock_rad, 0.1, 30);
  in.number("steering.ackermann", steering.ackermann, -1, 2);
  in.number("steering.mechanical_trail_m", steering.mechanical_trail_m, -0.1, 0.2);
  in.number("steering.scrub_radius_m", steering.scrub_radius_m, -0.1, 0.2);
  in.number("steering.column_stiffness_nmprad", steering.column_stiffness_nmprad, 0, 1e4);
  in.number("steering.rack_damping_nmsprad", steering.rack_damping_nmsprad, 0.1, 100);
  in.number("steering.friction_nm", steering.friction_nm, 0, 20);
  in.number("steering.centring_nmprad", steering.centring_nmprad, 0, 2000);
  in.table("steering.assistance", steering.assistance, 0, 1);
}

void read_engine(Entries& in, PowertrainParameters& p) {
  in.table("powertrain.full_torque_nm", p.full_torque_nm, 0, 5e3);
  in.table("powertrain.closed_torque_nm", p.closed_torque_nm, -5e3, 0);
  in.whole("powertrain.cylinders", p.cylinders, 1, 16);
  in.number("powertrain.engine_inertia_kgm2", p.engine_inertia_kgm2, 0.02, 10);
  in.number("powertrain.idle_radps", p.idle_radps, 30, 200);
  in.number("powertrain.most_radps", p.most_radps, 100, 2000);
  in.number("powertrain.torque_lag_s", p.torque_lag_s, 0, 2);
  in.list("powertrain.gear_ratios", p.gear_ratio, p.gear_count);
  in.number("powertrain.reverse_ratio", p.reverse_ratio, 0.5, 20);
  in.number("powertrain.final_ratio", p.final_ratio, 0.5, 20);
  in.number("powertrain.efficiency", p.efficiency, 0.3, 1);
  in.number("powertrain.shift_time_s", p.shift_time_s, 0.02, 3);
  in.number("powertrain.upshift_closed_radps", p.upshift_closed_radps, 50, 2000);
  in.number("powertrain.upshift_open_radps", p.upshift_open_radps, 50, 2000);
  in.number("powertrain.downshift_closed_radps", p.downshift_closed_radps, 20, 2000);
  in.number("powertrain.downshift_open_radps", p.downshift_open_radps, 20, 2000);
  in.number("powertrain.clutch_capacity_nm", p.clutch_capacity_nm, 10, 5000);
  if (p.transmission != Transmission::automatic) return;
  in.table("powertrain.converter_capacity", p.converter_capacity, -1, 1);
  in.table("powertrain.converter_ratio", p.converter_ratio, 0, 10);
  in.whole("powertrain.lowest_lockup_gear", p.lowest_lockup_gear, 0, 8);
  in.number("powertrain.lockup_speed_radps", p.lockup_speed_radps, 0, 2000);
}

void read_powertrain(Entries& in, PowertrainParameters& p) {
  const std::string word = in.word("powertrain.transmission");
  in.number("powertrain.front_share", p.front_share, 0, 1);
  if (word == "direct") {
    p.transmission = Transmission::direct;
    in.number("powertrain.direct_acceleration_mps2", p.direct_acceleration_mps2, 0.1, 50);
    in.number("powertrain.direct_power_speed_mps", p.direct_power_speed_mps, 0.1, 100);
    return;
  }
  if (word != "automatic" && word != "manual")
    return in.fail("is not a transmission", "powertrain.transmission", "write \"automatic\", \"manual\" or \"direct\"");
  p.transmission = word == "manual" ? Transmission::manual : Transmission::automatic;
  read_engine(in, p);
}

void read_brakes(Entries& in, BrakeParameters& brakes) {
  in.number("brakes.front_torque_nm", brakes.full_torque_nm[0], 0, 2e4);
  in.number("brakes.rear_torque_nm", brakes.full_torque_nm[1], 0, 2e4);
  in.number("brakes.parking_torque_nm", brakes.parking_torque_nm, 0, 2e4);
  in.number("brakes.lag_s", brakes.lag_s, 0, 1);
  in.flag("brakes.anti_lock", brakes.anti_lock);
  in.flag("brakes.traction_control", brakes.traction_control);
  in.flag("brakes.stability_control", brakes.stability_control);
  in.number("brakes.anti_lock_slip", brakes.anti_lock_slip, 0.02, 0.5);
  in.number("brakes.understeer_radps2pm", brakes.understeer_radps2pm, 0, 0.02);
}

}  // namespace

Expected<VehicleParameters> read_vehicle(std::string_view text, std::string_view name) {
  const auto root = document::parse_toml(text, name);
  if (!root) return tl::unexpected(root.error());
  VehicleParameters parameters;
  Entries in(*root, name);
  read_body(in, parameters.body);
  read_suspension(in, "front", parameters.suspension[0]);
  read_suspension(in, "rear", parameters.suspension[1]);
  read_tyre(in, parameters.tyre);
  read_steering(in, parameters.steering);
  read_powertrain(in, parameters.powertrain);
  read_brakes(in, parameters.brakes);
  if (in.has("verification")) in.flag("verification.as_published", parameters.as_published);
  const double unsprung_kg =
      2.0 * (parameters.suspension[0].unsprung_mass_kg + parameters.suspension[1].unsprung_mass_kg);
  if (unsprung_kg > 0.6 * parameters.body.mass_kg)
    in.fail("is less than twice the unsprung masses", "body.mass_kg", "correct one of them");
  if (parameters.body.mass_centre_x_m >= parameters.body.wheelbase_m)
    in.fail("lies in front of the front axle", "body.mass_centre_x_m", "keep it between the axles");
  in.refuse_unknown();
  if (in.error()) return tl::unexpected<Error>(*in.error());
  return parameters;
}

}  // namespace septet::vehicle
