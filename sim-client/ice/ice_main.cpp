/// `septet-ice`: an object of ice, alone and turning. `septet ice` starts it.

#include <string>

#include <fmt/core.h>

#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "sim-client/ice/ice_viewer.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  using program::number_between;
  ice_viewer::IceOptions options;
  CLI::App app{
      "Draw an object of ice alone, turning, after Seipel and Nivfors (2006); every part can be switched off.\n"
      "  septet ice --object teapot --mode quality --cracks 4 --out teapot",
      "septet ice"};
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("septet: {}; septet ice --help shows the options\n", error.what());
  });
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  app.add_option("--object", options.object, "sphere, cube, peanut, teapot, or an OBJ file");
  std::string mode = "paper", surroundings = "outdoors";
  app.add_option("--mode", mode, "paper: its four equations. quality: light followed from face to face")
      ->check(CLI::IsMember({"paper", "quality"}));
  app.add_option("--surroundings", surroundings,
                 "outdoors: sun, field and columns. room: a panorama, as references have it")
      ->check(CLI::IsMember({"outdoors", "room"}));
  std::string shown = "all";
  app.add_option("--show", shown,
                 "all; or the depth of the faces in front or behind, as figure 5 of the paper shows them")
      ->check(CLI::IsMember({"all", "front-depth", "back-depth"}));
  bool one_sided = false, as_a_lens = false, no_reflection = false, straight_cracks = false, alone = false;
  app.add_flag("--one-sided", one_sided, "The front face alone refracts");
  app.add_flag("--as-a-lens", as_a_lens, "Equation 1 with the back face's normal added, not taken away as printed");
  app.add_option("--back-share", options.look.back_share, "Share of the back face's normal in equation 1")
      ->check(number_between(0.0, 1.0));
  app.add_flag("--no-reflection", no_reflection, "Nothing is mirrored on the surface");
  app.add_option("--cracks", options.cracks, "Number of cracks inside")->check(CLI::Range(0u, 100000u));
  app.add_option("--air", options.air_planes, "Number of planes with bubbles of air")->check(CLI::Range(0u, 1000u));
  app.add_flag("--straight-cracks", straight_cracks, "In quality mode: cracks do not bend what is seen through them");
  app.add_flag("--nothing-beyond", alone, "In quality mode: light that has left the ice meets no other ice behind it");
  app.add_flag("--pair", options.pair, "A second one stands behind it");
  app.add_flag("--mark-cracks", options.mark_cracks, "Cracks in red, as figure 5 of the paper shows their clipping");
  app.add_option("--bump", options.look.bump, "Slope of the surface's unevenness")->check(number_between(0.0, 1.0));
  app.add_option("--bump-size", options.look.bump_size_m, "Length of its waves, m; the object is a metre across")
      ->check(number_between(0.001, 10.0));
  app.add_option("--frost", options.look.roughness, "How white the cold has made the surface, 0: wet and clear")
      ->check(number_between(0.0, 1.0));
  app.add_option("--wet", options.look.wetness, "How wet it is: what it mirrors is sharp, and frost is gone")
      ->check(number_between(0.0, 1.0));
  double absorption = 1.0;
  app.add_option("--absorption", absorption, "Of clear ice's absorption, which makes it blue; 0: none")
      ->check(number_between(0.0, 1000.0));
  app.add_option("--seed", options.seed, "Of the cracks' and bubbles' places")->check(program::seed_number());
  app.add_option("--share", options.share_of_picture, "Of the picture that the object covers, about")
      ->check(number_between(0.01, 4.0));
  app.add_option("--width", options.width_px, "Of a picture, pixels")->check(CLI::Range(16u, 8192u));
  app.add_option("--height", options.height_px, "Of a picture, pixels")->check(CLI::Range(16u, 8192u));
  app.add_option("--pictures", options.pictures, "Of one turn")->check(CLI::Range(1u, 10000u));
  app.add_option("--surroundings-size", options.surroundings_px, "Side of each face of the cube map, pixels")
      ->check(CLI::Range(8u, 2048u));
  app.add_flag("--still-surroundings", options.surroundings_kept,
               "The cube map is drawn once and not for every picture");
  app.add_flag("--software", options.software, "Draw without a graphics card");
  app.add_flag("--window", options.window, "In a window until Escape; its keys switch each part on and off");
  app.add_option("--turn", options.turn_deg, "Of the first picture, degrees")->check(number_between(-360.0, 360.0));
  app.add_option("--out", options.out, "Folder for the pictures; those that are there are replaced");
  app.add_option("--reference", options.reference, "Folder for what a path tracer needs to draw the same")
      ->default_str("");
  return program::run("septet", app, argc, argv, [&] {
    options.look.mode = mode == "quality" ? ice::Mode::quality : ice::Mode::paper;
    options.surroundings = surroundings == "room" ? ice_viewer::Surroundings::room : ice_viewer::Surroundings::outdoors;
    options.look.two_sided = !one_sided;
    options.look.shown = shown == "front-depth"  ? ice::Shown::front_depth
                         : shown == "back-depth" ? ice::Shown::back_depth
                                                 : ice::Shown::all;
    options.look.absorption_per_m *= static_cast<float>(absorption);
    options.look.back_sign = as_a_lens ? ice::BackSign::as_a_lens : ice::BackSign::as_printed;
    options.look.reflects = !no_reflection;
    options.look.bent_by_cracks = !straight_cracks;
    options.look.seen_beyond = !alone;
    return ice_viewer::run_ice(options);
  });
}
