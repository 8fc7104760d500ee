#include "sim-client/screen/screen_display.hpp"

namespace septet::screen {
namespace {

/// Off-screen: pictures for tests, CI and logs.
class VirtualDisplay final : public Display {
 public:
  explicit VirtualDisplay(render::Renderer renderer) : renderer_(std::move(renderer)) {}
  render::Renderer& renderer() override { return renderer_; }
  std::optional<Size> window_size() const override { return std::nullopt; }
  void attend() override {}
  Leaving poll_leaving() override { return Leaving::no; }
  std::optional<DriverInput> controls(double, double) override { return std::nullopt; }
  bool is_touched() const override { return false; }
  bool take_keys_request() override { return false; }
  bool paces_itself() const override { return false; }

 private:
  render::Renderer renderer_;
};

}  // namespace

Expected<std::unique_ptr<Display>> Display::open(const DisplayOptions& options) {
  render::RendererOptions renderer_options;
  renderer_options.width = options.width_px;
  renderer_options.height = options.height_px;
  renderer_options.validation = options.validation;
  if (!options.is_virtual) return open_window(options, renderer_options);
  renderer_options.device = render::DevicePreference::software;
  auto renderer = render::Renderer::create(renderer_options);
  if (!renderer) return tl::unexpected(renderer.error());
  return std::make_unique<VirtualDisplay>(std::move(*renderer));
}

}  // namespace septet::screen
