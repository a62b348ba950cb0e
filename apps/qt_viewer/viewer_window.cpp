#include "apps/qt_viewer/viewer_window.h"

#include <GeographicLib/UTMUPS.hpp>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QStatusBar>
#include <QTableWidget>
#include <QTreeWidget>

namespace manzana::qt {
namespace {

struct LayerRow {
  const char* name;
  bool draw::Layers::*shown;
};
constexpr LayerRow kLayers[] = {{"Buildings", &draw::Layers::buildings},
                                {"Streets and ground", &draw::Layers::surfaces},
                                {"Trees", &draw::Layers::trees},
                                {"Cars", &draw::Layers::cars},
                                {"Sky", &draw::Layers::sky}};

constexpr const char* kPictures = "Pictures with their place (*.tif *.tiff *.png *.jpg)";

QString name_of(ObjectClass kind) {
  if (kind == kBuilding) return "building";
  return kind == kTree ? "tree" : "street or ground";
}

using Rows = std::vector<std::pair<QString, QString>>;

Rows rows_of(const Nodes& nodes, NodeId id) {
  QString name;
  for (NodeId at = id; at != 0; at = nodes.node(at).parent)
    if (!nodes.node(at).name.empty())
      name = QString::fromStdString(nodes.node(at).name) + (name.isEmpty() ? "" : " / ") + name;
  return {{"kind", "added"}, {"number", QString::number(id)}, {"name", name}};
}

Rows rows_of(const Feature& f) {
  const Vec3d size = f.box.max - f.box.min;
  const auto metres = [](double m) { return QString("%1 m").arg(m, 0, 'f', 1); };
  Rows rows{{"kind", name_of(f.kind)},      {"number", QString::number(f.id)},
            {"height", metres(size.z)},     {"extent", metres(size.x) + " x " + metres(size.y)},
            {"place", geographic(f.place)}, {"projected", projected(f.place)}};
  const auto text = [](std::string_view s) { return QString::fromUtf8(s.data(), static_cast<int>(s.size())); };
  for (std::size_t i = 0; i < f.attributes.size(); ++i)
    rows.emplace_back(text(f.attributes[i].first), text(f.attributes[i].second));
  return rows;
}

}  // namespace

QString geographic(const GeoPoint& p) {
  return QString("%1 %2, %3 %4, %5 m")
      .arg(std::abs(p.lat_deg), 0, 'f', 6)
      .arg(p.lat_deg < 0 ? "S" : "N")
      .arg(std::abs(p.lon_deg), 0, 'f', 6)
      .arg(p.lon_deg < 0 ? "W" : "E")
      .arg(p.height_m, 0, 'f', 1);
}

QString projected(const GeoPoint& p) {
  int zone = 0;
  bool north = true;
  double east = 0, northing = 0;
  GeographicLib::UTMUPS::Forward(p.lat_deg, p.lon_deg, zone, north, east, northing);
  const QString system = zone == 0 ? QString("UPS ") : QString("UTM %1").arg(zone);
  return QString("%1%2 %3 E, %4 N").arg(system, north ? "N" : "S").arg(east, 0, 'f', 1).arg(northing, 0, 'f', 1);
}

ViewerWindow::ViewerWindow() : city_(new CityWidget(this)) {
  setCentralWidget(city_);
  setAcceptDrops(true);
  setWindowTitle("Manzana");
  make_layers();
  make_attributes();
  make_menu();
  where_ = new QLabel(this);
  statusBar()->addPermanentWidget(where_);
  city_->told = [this](const QString& line) { statusBar()->showMessage(line); };
  city_->clicked = [this](const QPoint& at) { identify(at); };
  city_->pointed = [this](const QPoint& at) { point(at); };
}

void ViewerWindow::make_layers() {
  layers_ = new QTreeWidget(this);
  layers_->setHeaderHidden(true);
  auto* all = new QTreeWidgetItem(layers_, {"City"});
  for (const LayerRow& layer : kLayers) {
    auto* item = new QTreeWidgetItem(all, {layer.name});
    item->setCheckState(0, city_->drawing().layers.*layer.shown ? Qt::Checked : Qt::Unchecked);
  }
  all->setExpanded(true);
  connect(layers_, &QTreeWidget::itemChanged, this, [this, all](QTreeWidgetItem* item, int) {
    if (const int row = all->indexOfChild(item); row >= 0)
      city_->drawing().layers.*kLayers[row].shown = item->checkState(0) == Qt::Checked;
    if (item == added_ && city_->nodes() != nullptr)
      city_->nodes()->show(city_->added(), item->checkState(0) == Qt::Checked);
    city_->update();
  });
  auto* dock = new QDockWidget("Layers", this);
  dock->setWidget(layers_);
  addDockWidget(Qt::LeftDockWidgetArea, dock);
}

void ViewerWindow::make_attributes() {
  attributes_ = new QTableWidget(0, 2, this);
  attributes_->horizontalHeader()->hide();
  attributes_->horizontalHeader()->setStretchLastSection(true);
  attributes_->verticalHeader()->hide();
  attributes_->setEditTriggers(QTableWidget::NoEditTriggers);
  auto* dock = new QDockWidget("Identified", this);
  dock->setWidget(attributes_);
  addDockWidget(Qt::LeftDockWidgetArea, dock);
}

void ViewerWindow::make_menu() {
  QMenu* file = menuBar()->addMenu("&File");
  file->addAction("&Open...", QKeySequence::Open, this, [this] {
    const QString name = QFileDialog::getOpenFileName(
        this, "A city", {}, "Cities (*.osm *.pbf *.gz *.bz2 *.json *.jsonl *.manzana);;All (*)");
    if (!name.isEmpty()) open(name);
  });
  file->addAction("Built-in &town", this, [this] { open("builtin:town"); });
  file->addAction("&Lay picture over the ground...", this, [this] {
    const QString name = QFileDialog::getOpenFileName(this, "A picture from the air", {}, kPictures);
    if (!name.isEmpty()) lay(name);
  });
  file->addAction("&Add model...", this, [this] {
    const QString name = QFileDialog::getOpenFileName(this, "A building", {}, "glTF (*.glb *.gltf)");
    if (!name.isEmpty() && city_->model() != nullptr) add(name, city_->rect().center());
  });
  file->addAction("Save &picture...", QKeySequence::Save, this, [this] {
    const QString name = QFileDialog::getSaveFileName(this, "A picture", "city.png", "PNG (*.png)");
    if (!name.isEmpty() && !save(name)) statusBar()->showMessage(name + ": cannot be written");
  });
  file->addAction("&Quit", QKeySequence::Quit, this, [this] { close(); });
}

void ViewerWindow::open(const QString& file, const QString& orthophoto) {
  city_->open(file.toStdString(), orthophoto.toStdString());
}

void ViewerWindow::lay(const QString& orthophoto) { open(QString::fromStdString(city_->city()), orthophoto); }

void ViewerWindow::add(const QString& gltf, const QPoint& at) {
  if (city_->add(gltf.toStdString(), at) == 0) return;
  if (added_ == nullptr) added_ = new QTreeWidgetItem(layers_, {"Added"});
  added_->setCheckState(0, Qt::Checked);
}

bool ViewerWindow::save(const QString& file) { return city_->grabFramebuffer().save(file); }

void ViewerWindow::identify(const QPoint& at) {
  const FeatureId id = city_->feature_at(at);
  const bool node = city_->nodes() != nullptr && city_->nodes()->contains(id);
  const Rows rows = id == 0 ? Rows{{"nothing", ""}}
                    : node  ? rows_of(*city_->nodes(), id)
                            : rows_of(city_->model()->feature(id));
  attributes_->setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < attributes_->rowCount(); ++row) {
    attributes_->setItem(row, 0, new QTableWidgetItem(rows[static_cast<std::size_t>(row)].first));
    attributes_->setItem(row, 1, new QTableWidgetItem(rows[static_cast<std::size_t>(row)].second));
  }
}

void ViewerWindow::point(const QPoint& at) {
  const auto place = city_->place_at(at);
  if (!place) return where_->clear();
  const GeoPoint geo = city_->model()->frame().to_geo(*place);
  where_->setText(geographic(geo) + "   " + projected(geo));
}

void ViewerWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void ViewerWindow::dropEvent(QDropEvent* event) {
  const auto urls = event->mimeData()->urls();
  if (urls.isEmpty()) return;
  const QString file = urls.front().toLocalFile();
  if (city_->model() != nullptr && (file.endsWith(".glb") || file.endsWith(".gltf")))
    add(file, city_->mapFrom(this, event->position().toPoint()));
  else if (city_->model() != nullptr && (file.endsWith(".tif") || file.endsWith(".tiff")))
    lay(file);
  else
    open(file);
}

}  // namespace manzana::qt
