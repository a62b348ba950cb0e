// A picture from the air in a widget.
#include "tests/qt_viewer/pictures.h"
#include "tests/support/quartered_photo.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::qt;

TEST_CASE("qt: a picture from the air is laid over the ground of the city that is shown") {
  const TemporaryFolder folder;
  ViewerWindow window;
  window.resize(700, 450);
  window.show();
  window.open("builtin:town");
  picture_of(window.city());
  const auto photo = folder.path() / "air.tif";
  support::write_quartered(photo, window.city().model()->frame());
  const Model* before = window.city().model();
  window.lay(QString::fromStdString(photo.string()));
  wait_until([&] { return window.city().model() != before; });
  CityWidget& city = window.city();
  city.drawing().layers.trees = city.drawing().layers.cars = false;
  city.update();
  const QImage image = picture_of(city);
  int ground = 0, right = 0;
  for (int y = 0; y < city.height(); y += 12)
    for (int x = 0; x < city.width(); x += 12) {
      const FeatureId id = city.feature_at({x, y});
      const auto at = city.place_at({x, y});
      if (id == 0 || !at || city.model()->feature(id).kind != kSurface || support::near_a_seam(*at)) continue;
      if (std::max(std::abs(at->x), std::abs(at->y)) > 480) continue;
      const QRgb c = image.pixel(x, y);
      ++ground;
      right += support::is_quarter(qRed(c), qGreen(c), qBlue(c), *at) ? 1 : 0;
    }
  CHECK(ground > 150);
  CHECK(right > 0.95 * ground);
}
