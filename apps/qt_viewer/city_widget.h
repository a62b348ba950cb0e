#pragma once
/// A city in a Qt widget: what a GIS program would write to embed manzana/view.h.
///   CityWidget* city = new CityWidget(window);
///   city->open("city.osm.pbf");           // on a thread; told() when it is there, or why not
#include <QOpenGLWidget>
#include <QPoint>
#include <functional>
#include <thread>

#include "manzana/view.h"

namespace manzana::qt {

/// OpenGL 4.5 for every widget of the program; before the QApplication is made.
void ask_for_context();

class CityWidget : public QOpenGLWidget {
 public:
  explicit CityWidget(QWidget* parent = nullptr);
  ~CityWidget() override;

  /// `orthophoto`: laid over the ground; empty: none.
  void open(const std::string& city, const std::string& orthophoto = {});
  const std::string& city() const { return city_; }  ///< the last that was to be opened
  const Model* model() const { return model_.get(); }
  bool shown() const { return update_.shown; }
  bool complete() const { return view_.complete(); }
  draw::DrawOptions& drawing() { return view_.drawing(); }  ///< update() afterwards

  /// A building as glTF onto what stands in a pixel of the widget; told() why not. 0: there is no place for it.
  NodeId add(const std::string& gltf, const QPoint& at);
  Nodes* nodes() { return nodes_.get(); }  ///< nullptr: nothing was added; update() after changes
  NodeId added() const { return added_; }  ///< the layer of all that was added

  /// What stands in a pixel of the widget, from its upper left corner; 0: nothing.
  FeatureId feature_at(const QPoint& at);
  /// Where: in the model's frame.
  std::optional<Vec3d> place_at(const QPoint& at);

  std::function<void(const QString& line)> told = [](const QString&) {};  ///< what the user should know
  std::function<void(bool)> opened = [](bool) {};                         ///< true: there is another model
  std::function<void(const QPoint& at)> pointed = [](const QPoint&) {};   ///< the mouse moved, no button pressed
  std::function<void(const QPoint& at)> clicked = [](const QPoint&) {};
  std::function<void()> drawn_before = [] {}, drawn_after = [] {};  ///< drawing of the host's own, the context current

 protected:
  void initializeGL() override;
  void paintGL() override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  HostCamera camera() const;
  draw::PixelRect pixel_at(const QPoint& at) const;
  void took(std::shared_ptr<const Model> model, const QString& error);

  View view_;
  Update update_;
  std::string city_;
  std::shared_ptr<const Model> model_;
  std::shared_ptr<Nodes> nodes_;
  NodeId added_ = 0;
  std::thread loader_;
  Vec3d target_{0, 0, 0};
  double yaw_ = 0, pitch_ = -0.6, distance_ = 500;  ///< radians, metres
  QPoint last_;
  bool moved_ = false;
};

}  // namespace manzana::qt
