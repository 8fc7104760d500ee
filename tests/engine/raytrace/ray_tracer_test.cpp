#include "engine/raytrace/ray_tracer.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include <doctest/doctest.h>

#include "engine/light/beam.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

bool same_bits(const TracedPicture& a, const TracedPicture& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(TracedPixel)) == 0;
}

}  // namespace

TEST_CASE("a picture is the same bit for bit in any order of any buckets on any number of threads") {
  const scene::ResolvedScene box = cornell_box();
  auto tracer = RayTracer::create(box);
  REQUIRE(tracer.has_value());
  TraceSettings settings = cornell_settings(2);
  settings.filter = Filter::cubic;
  tracer->begin(before_cornell_box(40), settings);
  const TracedPicture whole = whole_picture(*tracer, 40, 40);
  for (const std::uint32_t side_px : {7u, 33u, 40u}) {
    TracedPicture other(40, 40);
    auto buckets = buckets_of(40, 40, side_px);
    std::reverse(buckets.begin(), buckets.end());
    for (const auto& rectangle : buckets) other.put(tracer->trace(rectangle));
    CHECK(same_bits(whole, other));
  }
  // Another machine builds its own hierarchies.
  CHECK(same_bits(whole, traced(box, before_cornell_box(40), settings)));
  settings.seed = 1;
  CHECK_FALSE(same_bits(whole, traced(box, before_cornell_box(40), settings)));
}

TEST_CASE("a picture that takes samples as it needs them is the same bit for bit however it is shared out") {
  const scene::ResolvedScene box = cornell_box();
  auto tracer = RayTracer::create(box);
  REQUIRE(tracer.has_value());
  TraceSettings settings = cornell_settings(64);
  settings.error = 0.12f;
  instant::Instant instant = before_cornell_box(22);
  instant.exposure = instant::exposure_of_scale(1.0f);
  tracer->begin(instant, settings);
  const TracedPicture whole = whole_picture(*tracer, 22, 22);
  for (const std::uint32_t side_px : {7u, 22u}) {
    TracedPicture other(22, 22);
    auto buckets = buckets_of(22, 22, side_px);
    std::reverse(buckets.begin(), buckets.end());
    for (const auto& rectangle : buckets) other.put(tracer->trace(rectangle));
    CHECK(same_bits(whole, other));
  }
  std::uint32_t least = 1000, most = 0;
  for (const TracedPixel& pixel : whole.pixels)
    least = std::min(least, pixel.samples), most = std::max(most, pixel.samples);
  CHECK(least == 16);
  CHECK(most == 64);
}

TEST_CASE("a sample is the same bit for bit whichever samples beside it are asked for") {
  for (const scene::ResolvedScene& box : {cornell_box(), each_alone(cornell_box())}) {
    auto tracer = RayTracer::create(box);
    REQUIRE(tracer.has_value());
    constexpr std::uint32_t samples = 21;
    tracer->begin(before_cornell_box(24), cornell_settings(samples));
    const instant::PixelRectangle all{0, 0, 24, 24};
    const Bucket whole = tracer->trace(all);
    std::vector<glm::vec3> sums(whole.pixels.size(), glm::vec3(0.0f));
    for (std::uint32_t n = 0; n < samples; ++n) {
      const Bucket one = tracer->trace(all, {n, n + 1});
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += one.pixels[k].radiance;
    }
    std::size_t same = 0;
    for (std::size_t k = 0; k < sums.size(); ++k)
      same += sums[k] * (1.0f / static_cast<float>(samples)) == whole.pixels[k].radiance;
    CHECK(same == sums.size());
  }
}

TEST_CASE("a mirrored view is the view with left and right exchanged") {
  const scene::ResolvedScene box = cornell_box();
  instant::Instant plain = before_cornell_box(24), mirrored = plain;
  // Only the first surface counts, and it is the same for every sample of a pixel's middle.
  plain.views[0].projection.left_slope *= 1.3;
  mirrored.views[0].projection.left_slope *= 1.3;
  mirrored.views[0].mirrored = true;
  const TraceSettings settings = cornell_settings(16);
  const TracedPicture a = traced(box, plain, settings), b = traced(box, mirrored, settings);
  int differing = 0;
  for (std::uint32_t y = 0; y < 24; ++y)
    for (std::uint32_t x = 0; x < 24; ++x)
      differing += glm::distance(a.pixels[y * 24 + x].albedo, b.pixels[y * 24 + 23 - x].albedo) > 0.35f;
  CHECK(differing < 12);
  int same_way_round = 0;
  for (std::uint32_t y = 0; y < 24; ++y)
    for (std::uint32_t x = 0; x < 24; ++x)
      same_way_round += glm::distance(a.pixels[y * 24 + x].albedo, b.pixels[y * 24 + x].albedo) > 0.35f;
  CHECK(same_way_round > 30);
}

TEST_CASE("the variance that a pixel tells is that of its mean over other seeds") {
  const scene::ResolvedScene box = cornell_box();
  double told = 0.0, found = 0.0;
  const auto light = [](const TracedPixel& pixel) {
    return glm::dot(pixel.radiance, glm::vec3(0.2126f, 0.7152f, 0.0722f));
  };
  for (std::uint64_t seed = 0; seed < 6; seed += 2) {
    const TracedPicture a = traced(box, before_cornell_box(24), cornell_settings(16, seed)),
                        b = traced(box, before_cornell_box(24), cornell_settings(16, seed + 1));
    for (std::size_t n = a.pixels.size() / 3; n < a.pixels.size(); ++n) {
      told += a.pixels[n].variance + b.pixels[n].variance;
      const double off = light(a.pixels[n]) - light(b.pixels[n]);
      found += off * off;
    }
  }
  CHECK(found / told == relative(1.0, 0.25));
}

TEST_CASE("light that is not a number is counted and black") {
  scene::SurfaceMaterial material;
  material.emission = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  const TracedPicture picture =
      traced(ball_scene(material, 1), instant_from({-4.0, 0.0, 0.0}, 0.7, 16, even_sky(0.25f)), {.samples = 4});
  CHECK(picture.bad_samples > 0);
  for (const TracedPixel& pixel : picture.pixels) CHECK(std::isfinite(pixel.radiance.x));
}

TEST_CASE(
    "a pixel says which object is seen and whose part it is by numbers that do not change with what else is there") {
  scene::ResolvedScene scene = ball_scene({}, 1);
  scene.instances.front().world_from_object.position_m = {50.0, 0.0, 0.0};
  scene.instances.front().visible_to_m = 100.0f;
  scene.instances.push_back(scene.instances.front());
  scene.instances.back().world_from_object.position_m = {0.0, 1.5, 0.0};
  instant::Instant instant = instant_from({-6.0, 0.0, 0.0}, 0.9, 32, even_sky(0.25f));
  instant::PlacedMesh part;
  part.origin_m = {0.0, -1.5, 0.0};
  part.number = 77;
  instant.parts.push_back(part);
  const auto check = [&] {
    const TracedPicture picture = traced(scene, instant, {.samples = 1, .filter = Filter::box});
    const TracedPixel &left = picture.at(7, 16), &right = picture.at(24, 16), &sky = picture.at(16, 1);
    CHECK(left.object == 2);
    CHECK(left.participant == 0);
    CHECK(right.object == 3);  // Behind the two instances: the first mesh as a part.
    CHECK(right.participant == 77);
    CHECK(sky.object == 0);
    CHECK(sky.participant == 0);
  };
  check();
  scene.instances.front().visible_to_m = 1.0f;
  check();
}

TEST_CASE("where two levels of detail meet a share of the rays sees each and none sees neither") {
  scene::SurfaceMaterial bright;
  bright.emission = glm::vec3(1.0f);
  bright.base_color = glm::vec3(0.0f);
  scene::ResolvedScene scene = ball_scene(bright, 1);
  scene.materials.push_back(bright);
  scene.materials[1].emission = glm::vec3(0.0f, 3.0f, 0.0f);
  scene.meshes.push_back(scene.meshes[0]);
  for (scene::MeshPart& part : scene.meshes[1].parts) part.material = 1;
  scene.instances.push_back(scene.instances[0]);
  scene.instances[1].mesh = 1;
  // Three quarters of the fade band.
  const double eye_m = 8.0;
  scene.instances[0].visible_to_m = scene.instances[1].visible_from_m =
      static_cast<float>(eye_m) / (1.0f + 0.5f * instant::fade_half_band);
  const std::uint32_t side_px = 32;
  const TracedPicture picture =
      traced(scene, instant_from({-eye_m, 0.0, 0.0}, 0.05, side_px, even_sky(0.0f)), {.samples = 16});
  double nearer = 0.0, further = 0.0;
  for (const TracedPixel& pixel : picture.pixels)
    nearer += pixel.radiance.r / (side_px * side_px), further += pixel.radiance.g / (side_px * side_px);
  const double share = instant::fade_at(static_cast<float>(eye_m), 0.0f, scene.instances[0].visible_to_m).share();
  CHECK(share == relative(0.25, 0.05));
  CHECK(nearer == relative(share, 0.05));
  CHECK(further == relative(share + 3.0 * (1.0 - share), 0.02));
}

TEST_CASE("soot takes the same share of the light of a matt surface, a mirror, lacquer and a lamp") {
  scene::SurfaceMaterial matt, mirror, lacquer, lamp;
  matt.base_color = glm::vec3(0.8f);
  mirror.metallic = 1.0f, mirror.roughness = 0.3f;
  lacquer.base_color = glm::vec3(0.0f), lacquer.clear_coat = 1.0f;
  lamp.base_color = glm::vec3(0.0f), lamp.emission = glm::vec3(2.0f);
  for (const scene::SurfaceMaterial& material : {matt, mirror, lacquer, lamp}) {
    const scene::ResolvedScene scene = ball_scene(material, 2);
    instant::Instant instant = instant_from({-4.0, 0.0, 0.0}, 0.2, 16, even_sky(0.25f));
    const double clean = mean_of(traced(scene, instant, {.samples = 32})).radiance.g;
    instant.soot.world_from_field.position_m = Vec3(-2.0);
    instant.soot.nx = instant.soot.ny = instant.soot.nz = 4;
    instant.soot.cover.assign(64, 102);
    const double sooty = mean_of(traced(scene, instant, {.samples = 32})).radiance.g;
    CAPTURE(material.metallic);
    CAPTURE(material.clear_coat);
    CHECK(clean > 1e-3);
    CHECK(sooty / clean == relative(0.6, 0.02));
  }
}

TEST_CASE("a part is seen where the mesh is that stands in for its own, and is what it was") {
  scene::ResolvedScene scene = ball_scene({}, 1);
  scene.instances.clear();
  instant::Instant instant = instant_from({-6.0, 0.0, 0.0}, 0.9, 32, even_sky(0.25f));
  instant::PlacedMesh part;
  part.number = 77;
  instant.parts.push_back(part);
  // Replaces its second half by the ball's upper half alone.
  auto halves = std::make_shared<instant::ReshapedParts>();
  scene::SurfaceMesh half = scene.meshes[0];
  for (scene::SurfaceVertex& vertex : half.vertices) vertex.position_m.z = std::max(vertex.position_m.z, 0.0f);
  halves->push_back(std::make_shared<const scene::SurfaceMesh>(half));
  const auto sees = [&] {
    const TracedPicture picture = traced(scene, instant, {.samples = 1, .filter = Filter::box});
    return std::array{picture.at(16, 13).participant, picture.at(16, 19).participant, picture.at(16, 13).object};
  };
  CHECK(sees() == std::array{77u, 77u, 1u});
  instant.reshaped.push_back(halves);
  instant.parts[0].reshaped = halves->front().get();
  CHECK(sees() == std::array{77u, 0u, 1u});
}

TEST_CASE("a point that is out of focus is a disc as wide as its circle of confusion and evenly bright") {
  // A small bright ball before black; the lens is sharp nearer, or further away, or there.
  scene::SurfaceMaterial bright;
  bright.emission = glm::vec3(1.0f);
  bright.base_color = glm::vec3(0.0f);
  scene::ResolvedScene scene = ball_scene(bright, 3);
  const double distance_m = 8.0, angle_rad = 0.2, lens_radius_m = 0.1, ball_m = 0.06;
  scene.instances.front().scale = glm::vec3(static_cast<float>(ball_m));
  const std::uint32_t side_px = 64;
  const instant::Instant instant = instant_from({-distance_m, 0.0, 0.0}, angle_rad, side_px, even_sky(0.0f));
  for (const double focus_m : {4.0, 16.0, 6.0, distance_m}) {
    CAPTURE(focus_m);
    const TracedPicture picture = traced(scene, instant,
                                         {.samples = 128,
                                          .filter = Filter::box,
                                          .lens_radius_m = static_cast<float>(lens_radius_m),
                                          .focus_m = static_cast<float>(focus_m)});
    // Moments of the light: a disc of radius r has r²/2 around its middle.
    double light = 0.0, moment = 0.0;
    for (std::uint32_t y = 0; y < side_px; ++y)
      for (std::uint32_t x = 0; x < side_px; ++x) {
        const double dx = x + 0.5 - 0.5 * side_px, dy = y + 0.5 - 0.5 * side_px, here = picture.at(x, y).radiance.x;
        light += here, moment += here * (dx * dx + dy * dy);
      }
    const double px_of_slope = side_px / (2.0 * std::tan(0.5 * angle_rad));
    const double confusion_px = lens_radius_m * std::abs(1.0 / focus_m - 1.0 / distance_m) * px_of_slope;
    const double ball_px = ball_m / distance_m * px_of_slope, pixel_moment = 1.0 / 6.0;
    const double expected = 0.5 * (confusion_px * confusion_px + ball_px * ball_px) + pixel_moment;
    CHECK(moment / light == relative(expected, 0.06));
    // Total light is independent of the focus.
    CHECK(light == relative(pi * ball_px * ball_px, 0.06));
  }
}

TEST_CASE("what the sun gives and what the sky gives add up whichever is looked at") {
  // The kind of light sampled is random; the result is not.
  scene::SurfaceMaterial white;
  white.base_color = glm::vec3(0.5f);
  white.roughness = 1.0f;
  scene::ResolvedScene scene = ball_scene(white, 3);
  const auto mean = [&](float sky, std::uint32_t seed) {
    auto light = *even_sky(sky);
    light.light_direction = glm::normalize(glm::vec3(-1.0f, 0.2f, 0.5f));
    light.light_irradiance = glm::vec3(2.0f);
    instant::Instant instant =
        instant_from({-4.0, 0.0, 0.0}, 0.3, 24, std::make_shared<const instant::SkyLight>(light));
    return mean_of(traced(scene, instant, {.samples = 64, .filter = Filter::box, .seed = seed}));
  };
  const PictureMean dark = mean(0.0f, 0), dim = mean(0.1f, 1);
  // The whole view is filled by the ball, which reflects half of the sky wherever it is convex.
  CHECK(std::abs(dim.radiance.x - dark.radiance.x - 0.05) < 4.0 * std::hypot(dark.sigma, dim.sigma) + 1e-4);
}

TEST_CASE("a dipped beam lights a wall as its table says in every direction") {
  scene::SurfaceMaterial grey;
  grey.base_color = glm::vec3(0.5f);
  grey.roughness = 1.0f;
  scene::ResolvedScene scene;
  scene.materials.push_back(grey);
  scene::SurfaceMesh wall;
  const glm::vec3 a{20, -40, -40}, b{20, 40, -40}, c{20, 40, 40}, d{20, -40, 40};
  add_triangle(wall, {a, c, b});
  add_triangle(wall, {a, d, c});
  wall.parts.push_back({0, 6, 0});
  wall.bounds_min_m = a, wall.bounds_max_m = c;
  scene.meshes.push_back(std::move(wall));
  scene.instances.push_back({});
  const float intensity = 1000.0f;
  const auto seen = [&](double down_rad, double aside_rad) {
    // The eye and the lamp are one point; the view is half a degree wide.
    instant::Instant instant = instant_from({0.0, 0.0, 0.0}, 0.004, 8, even_sky(0.0f));
    instant.views.front().projection = instant::symmetric_view({0.0, 0.0, 0.0}, aside_rad, -down_rad, 0.004, 0.004);
    instant.headlights.push_back({{0.0, 0.0, 0.0}, {1.0f, 0.0f, 0.0f}, intensity});
    return mean_of(traced(scene, instant, {.samples = 16, .filter = Filter::box})).radiance.x;
  };
  const auto expected = [&](double down_rad, double aside_rad) {
    const glm::vec3 ray(glm::dvec3(std::cos(down_rad) * std::cos(aside_rad), std::cos(down_rad) * std::sin(aside_rad),
                                   -std::sin(down_rad)));
    const double square = 400.0 / (ray.x * ray.x);
    return 0.5 / std::numbers::pi * intensity * light::dipped_share({1.0f, 0.0f, 0.0f}, ray, 1.0f) *
           light::beam_facing(ray.x) / (square + 1.0);
  };
  const double degree = std::numbers::pi / 180.0;
  for (const auto& way : {std::pair{1.7, 0.0}, {4.0, 0.0}, {-4.0, 0.0}, {1.7, 9.0}, {1.7, 20.0}}) {
    const double down = way.first, aside = way.second;
    const double radiance = seen(down * degree, aside * degree), table = expected(down * degree, aside * degree);
    INFO(down << " degrees down, " << aside << " aside");
    CHECK(radiance == relative(table, 0.08));
  }
}

TEST_CASE("a picture of sets of samples is that of all of them, whichever set is traced first, with the same error") {
  const scene::ResolvedScene scene = cornell_box();
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  const std::uint32_t samples = 13;
  tracer->begin(before_cornell_box(16), cornell_settings(samples));
  const instant::PixelRectangle all{0, 0, 16, 16};
  const Bucket whole = tracer->trace(all);
  for (const std::uint32_t count : {1u, 3u, 13u, 20u}) {  // Some of 20 sets are empty.
    std::vector<Bucket> sets(count);
    for (std::uint32_t n = count; n-- > 0;) sets[n] = tracer->trace(all, sample_set(samples, n, count));
    CAPTURE(count);
    for (std::size_t k = 0; k < whole.pixels.size(); ++k) {
      std::vector<TracedPixel> of_sets;
      for (const Bucket& set : sets) of_sets.push_back(set.pixels[k]);
      const TracedPixel& pixel = whole.pixels[k];
      const TracedPixel joined_pixel = joined(of_sets);
      CHECK(joined_pixel.samples == samples);
      CHECK(joined_pixel.radiance.x == doctest::Approx(pixel.radiance.x).epsilon(1e-5).scale(0.01));
      CHECK(joined_pixel.variance == doctest::Approx(pixel.variance).epsilon(1e-3).scale(1e-4));
      CHECK(joined_pixel.depth_m == pixel.depth_m);
      CHECK(joined_pixel.object == pixel.object);
    }
  }
}

}  // namespace septet::raytrace
