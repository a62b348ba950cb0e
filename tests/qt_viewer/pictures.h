#pragma once
/// What widgets show, once it is complete.
#include <QApplication>
#include <QElapsedTimer>
#include <catch2/catch.hpp>

#include "apps/qt_viewer/viewer_window.h"

namespace manzana::qt {

inline void wait_until(const std::function<bool()>& there, int seconds = 120) {
  QElapsedTimer clock;
  clock.start();
  while (!there() && clock.elapsed() < seconds * 1000) QApplication::processEvents(QEventLoop::AllEvents, 20);
  REQUIRE(there());
}

inline QImage picture_of(CityWidget& city) {
  wait_until([&] { return city.complete(); });
  city.repaint();
  return city.grabFramebuffer().convertToFormat(QImage::Format_RGB32);
}

}  // namespace manzana::qt
