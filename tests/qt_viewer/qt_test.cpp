// The view in Qt's widgets, on a display: what their life does to it. Run under xvfb-run.
#define CATCH_CONFIG_RUNNER
#include <QApplication>
#include <QElapsedTimer>
#include <QHBoxLayout>
#include <QMimeData>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTreeWidget>
#include <catch2/catch.hpp>

#include "tests/qt_viewer/pictures.h"

using namespace manzana::qt;

namespace {

bool is_background(QRgb c) {
  return std::abs(qRed(c) - 158) < 3 && std::abs(qGreen(c) - 194) < 3 && std::abs(qBlue(c) - 230) < 3;
}

double share_of_city(const QImage& image) {
  int city = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) city += is_background(image.pixel(x, y)) ? 0 : 1;
  return static_cast<double>(city) / (image.width() * image.height());
}

double difference(const QImage& a, const QImage& b) {
  REQUIRE(a.size() == b.size());
  int different = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      different +=
          std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) + std::abs(qBlue(p) - qBlue(q)) > 12 ? 1 : 0;
    }
  return static_cast<double>(different) / (a.width() * a.height());
}

}  // namespace

TEST_CASE("qt: a window is resized and its layers are switched and what stands there is identified") {
  ViewerWindow window;
  window.resize(700, 450);
  window.show();
  window.open("builtin:town");
  const QImage first = picture_of(window.city());
  CHECK(share_of_city(first) > 0.5);
  window.resize(500, 600);
  wait_until([&] { return window.city().width() < first.width(); });
  const QImage tall = picture_of(window.city());
  CHECK(share_of_city(tall) > 0.4);
  window.resize(700, 450);
  wait_until([&] { return window.city().width() == first.width(); });
  CHECK(difference(picture_of(window.city()), first) < 0.01);
  QTreeWidgetItem* buildings = window.layers().topLevelItem(0)->child(0);
  buildings->setCheckState(0, Qt::Unchecked);
  CHECK(difference(picture_of(window.city()), first) > 0.1);
  buildings->setCheckState(0, Qt::Checked);
  CHECK(difference(picture_of(window.city()), first) < 0.01);
  window.identify({window.city().width() / 2, window.city().height() / 2});
  REQUIRE(window.attributes().rowCount() == 6);
  CHECK(window.attributes().item(4, 1)->text().startsWith("41.6"));
  CHECK(window.attributes().item(5, 1)->text().startsWith("UTM 30N"));
  const auto place = window.city().place_at({window.city().width() / 2, window.city().height() / 2});
  REQUIRE(place);
  CHECK(std::abs(place->z) < 100);
}

TEST_CASE("qt: two widgets at once and one gets another window and so another context") {
  QWidget left, right;
  auto* row = new QHBoxLayout(&left);
  auto* moving = new CityWidget(&left);
  auto* staying = new CityWidget(&left);
  row->addWidget(moving);
  row->addWidget(staying);
  left.resize(800, 300);
  left.show();
  moving->open("builtin:town");
  staying->open("builtin:town");
  const QImage a = picture_of(*moving), b = picture_of(*staying);
  CHECK(difference(a, b) < 0.01);
  staying->setFixedSize(staying->size());  // else it takes the room that the other leaves
  const QOpenGLContext* before = moving->context();
  moving->setParent(nullptr);
  moving->resize(a.size());
  moving->show();
  wait_until([&] { return moving->context() != nullptr && moving->context() != before; });
  CHECK(difference(picture_of(*moving), a) < 0.01);
  CHECK(difference(picture_of(*staying), b) < 0.01);
  delete moving;
  CHECK(difference(picture_of(*staying), b) < 0.01);
}

TEST_CASE("qt: what the host draws before and after is unharmed") {
  CityWidget city;
  city.resize(400, 300);
  const auto square = [](int x, float r, float g, float b) {
    QOpenGLFunctions* gl = QOpenGLContext::currentContext()->functions();
    gl->glEnable(GL_SCISSOR_TEST);
    gl->glScissor(x, 280, 20, 20);
    gl->glClearColor(r, g, b, 1);
    gl->glClear(GL_COLOR_BUFFER_BIT);
    gl->glDisable(GL_SCISSOR_TEST);
  };
  city.drawn_before = [&] { square(0, 1, 0, 0); };
  city.drawn_after = [&] { square(40, 0, 1, 0); };
  city.show();
  city.open("builtin:town");
  const QImage image = picture_of(city);
  CHECK(image.pixel(5, 5) == qRgb(255, 0, 0));  // the sky: the city does not cover it
  CHECK(image.pixel(45, 5) == qRgb(0, 255, 0));
  CHECK(share_of_city(image) > 0.3);
}

TEST_CASE("qt: a file that is none is told and leaves what there was") {
  ViewerWindow window;
  window.show();
  QString said;
  std::vector<bool> opened;
  window.city().told = [&](const QString& line) { said = line; };
  window.city().opened = [&](bool there) { opened.push_back(there); };
  window.open("builtin:town");
  const QImage before = picture_of(window.city());
  window.open("/nowhere/city.osm");
  wait_until([&] { return opened.size() == 2; });
  CHECK(opened == std::vector<bool>{true, false});
  CHECK(said.startsWith("/nowhere/city.osm: "));
  CHECK(difference(picture_of(window.city()), before) < 0.01);
}

TEST_CASE("qt: a model is added where one points and its layer is switched") {
  QTemporaryDir folder;
  const QString file = folder.filePath("wall.gltf");
  {
    QFile out(file);
    REQUIRE(out.open(QIODevice::WriteOnly));
    out.write(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"name":"wall","mesh":0,"scale":[90,90,90],"translation":[-45,0,0]}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
      "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
      "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  }
  ViewerWindow window;
  window.resize(700, 450);
  window.show();
  window.open("builtin:town");
  const QImage before = picture_of(window.city());
  const QPoint middle = window.city().rect().center();
  window.add(file, middle);
  REQUIRE(window.layers().topLevelItemCount() == 2);
  CHECK(difference(picture_of(window.city()), before) > 0.004);
  window.identify(middle - QPoint(10, 10));
  REQUIRE(window.attributes().rowCount() == 3);
  CHECK(window.attributes().item(2, 1)->text().endsWith("wall.gltf / wall"));
  window.layers().topLevelItem(1)->setCheckState(0, Qt::Unchecked);
  CHECK(difference(picture_of(window.city()), before) == 0);
  window.add("/nowhere/wall.glb", middle);
  CHECK(window.layers().topLevelItemCount() == 2);
}

TEST_CASE("qt: places in words") {
  CHECK(geographic({-33.5, 151.25, 12.34}) == "33.500000 S, 151.250000 E, 12.3 m");
  CHECK(projected({60.17, 24.94, 0}).startsWith("UTM 35N 385"));
  CHECK(projected({89, 10, 0}).startsWith("UPS N"));
}

int main(int argc, char** argv) {
  ask_for_context();
  QApplication application(argc, argv);
  return Catch::Session().run(argc, argv);
}
