#pragma once
/// The window: the city, its layers, what is identified, where the mouse is.
#include <QMainWindow>

#include "apps/qt_viewer/city_widget.h"

class QLabel;
class QTableWidget;
class QTreeWidget;
class QTreeWidgetItem;

namespace manzana::qt {

/// "60.171020 N, 24.941380 E, 12.3 m"
QString geographic(const GeoPoint& place);
/// "UTM 35N 385 609 E, 6 672 193 N"; UPS near the poles.
QString projected(const GeoPoint& place);

class ViewerWindow : public QMainWindow {
 public:
  ViewerWindow();
  CityWidget& city() { return *city_; }
  void open(const QString& file, const QString& orthophoto = {});
  /// Over the ground of what is shown, which is read again; what was added to it goes.
  void lay(const QString& orthophoto);
  /// A building as glTF, at a pixel of the city.
  void add(const QString& gltf, const QPoint& at);
  /// The window as it is, to a file. False when that cannot be written.
  bool save(const QString& file);
  void identify(const QPoint& at);
  QTreeWidget& layers() { return *layers_; }
  QTableWidget& attributes() { return *attributes_; }

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void make_layers();
  void make_attributes();
  void make_menu();
  void point(const QPoint& at);

  CityWidget* city_;
  QTreeWidget* layers_ = nullptr;
  QTreeWidgetItem* added_ = nullptr;  ///< the layer of added models, once there is one
  QTableWidget* attributes_ = nullptr;
  QLabel* where_ = nullptr;
};

}  // namespace manzana::qt
