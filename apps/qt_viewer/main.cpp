// manzana-qt-viewer: a small GIS viewer round manzana/view.h. READ FIRST: city_widget.cpp.
#include <QApplication>
#include <QCommandLineParser>
#include <QStatusBar>
#include <QTimer>
#include <algorithm>
#include <cstdio>
#include <string_view>

#include "apps/qt_viewer/viewer_window.h"

namespace {

/// Once the city is drawn; 1 when it cannot be read.
void save_and_end(manzana::qt::ViewerWindow& window, const QString& file) {
  auto* timer = new QTimer(&window);
  QObject::connect(timer, &QTimer::timeout, [&window, file] {
    if (!window.city().complete()) return;
    window.identify({window.city().width() / 2, window.city().height() / 2});
    QApplication::exit(window.grab().save(file) ? 0 : 1);
  });
  window.city().opened = [&window, timer](bool there) {
    if (there) return timer->start(100);
    std::fprintf(stderr, "%s\n", qPrintable(window.statusBar()->currentMessage()));
    QApplication::exit(1);
  };
}

bool asks_for_help(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](std::string_view a) { return a == "-h" || a == "--help"; });
}

}  // namespace

int main(int argc, char** argv) {
  QCoreApplication::setApplicationName("manzana-qt-viewer");
  QCommandLineParser parser;
  parser.setApplicationDescription("Shows a city, its layers, and what is where.");
  parser.addHelpOption();
  parser.addPositionalArgument("CITY", "builtin:town, a file of OpenStreetMap or CityJSON, or a baked city", "[CITY]");
  const QCommandLineOption picture("screenshot", "write the window to FILE once the city is drawn, and end", "FILE");
  const QCommandLineOption photo("orthophoto", "a picture from the air over the ground (GDAL)", "FILE");
  parser.addOptions({picture, photo});
  if (asks_for_help(argc, argv)) parser.process(QCoreApplication(argc, argv));  // ends, and needs no display
  manzana::qt::ask_for_context();
  QApplication application(argc, argv);
  parser.process(application);
  manzana::qt::ViewerWindow window;
  window.resize(1100, 700);
  window.show();
  if (parser.isSet(picture)) save_and_end(window, parser.value(picture));
  window.open(parser.positionalArguments().value(0, "builtin:town"), parser.value(photo));
  return QApplication::exec();
}
