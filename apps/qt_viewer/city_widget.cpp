#include "apps/qt_viewer/city_widget.h"

#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QSurfaceFormat>
#include <QThreadPool>
#include <QWheelEvent>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "foliage/import/load_plant.h"
#include "scenegraph/import/model_file.h"

namespace manzana::qt {
namespace {

/// From whichever thread to the widget's; tasks to Qt's pool.
Host host_of(QWidget* widget) {
  const auto repaint = [widget] {
    QMetaObject::invokeMethod(
        widget, [widget] { widget->update(); }, Qt::QueuedConnection);
  };
  const auto run = [](std::function<void()> task) { QThreadPool::globalInstance()->start(std::move(task)); };
  return {.request_repaint = repaint, .run = run};
}

}  // namespace

void ask_for_context() {
  QSurfaceFormat format;
  format.setVersion(4, 5);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);
}

CityWidget::CityWidget(QWidget* parent) : QOpenGLWidget(parent), view_(host_of(this)) { setMouseTracking(true); }

CityWidget::~CityWidget() {
  if (loader_.joinable()) loader_.join();
  if (context() == nullptr) return;
  context()->disconnect(this);  // the base destroys the context when view_ is no more
  makeCurrent();
  view_.release();
  doneCurrent();
}

void CityWidget::open(const std::string& city, const std::string& orthophoto) {
  if (loader_.joinable()) loader_.join();
  city_ = city;
  told(QString("reading %1").arg(QString::fromStdString(city)));
  loader_ = std::thread([this, city, orthophoto] {
    std::shared_ptr<const Model> model;
    QString error;
    try {
      model =
          Model::load(city, {.threads = 2, .orthophoto = orthophoto, .plant_cache = foliage::default_cache_folder()});
    } catch (const std::exception& e) {
      error = QString::fromUtf8(e.what());
    }
    QMetaObject::invokeMethod(
        this, [this, model, error] { took(model, error); }, Qt::QueuedConnection);
  });
}

void CityWidget::took(std::shared_ptr<const Model> model, const QString& error) {
  if (model) {
    model_ = std::move(model);
    nodes_.reset();
    added_ = 0;
    const culling::BoxD& box = model_->scene().bounds;
    const Vec3d middle = (box.min + box.max) / 2.0;
    target_ = {middle.x, middle.y, 0};
    distance_ = std::clamp(glm::length(box.max - box.min) / 4, 150.0, 1500.0);
    view_.show(model_);
  }
  const QString credits = model_ ? QString::fromStdString(model_->credits()) : QString();
  told(error.isEmpty() ? credits : error);
  opened(error.isEmpty());
}

void CityWidget::initializeGL() {
  // The context goes before the widget does when that gets another window.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    view_.release();
    doneCurrent();
  });
}

HostCamera CityWidget::camera() const {
  const double ratio = devicePixelRatioF();
  HostCamera camera;
  camera.viewport = {0, 0, std::max(1, static_cast<int>(width() * ratio)),
                     std::max(1, static_cast<int>(height() * ratio))};
  const Vec3d away(std::sin(yaw_) * std::cos(pitch_), -std::cos(yaw_) * std::cos(pitch_), -std::sin(pitch_));
  camera.view = glm::lookAt(target_ + distance_ * away, target_, Vec3d(0, 0, 1));
  camera.projection =
      glm::perspective(glm::radians(50.0), static_cast<double>(camera.viewport.width) / camera.viewport.height,
                       distance_ / 100, distance_ * 100);
  return camera;
}

void CityWidget::paintGL() {
  QOpenGLFunctions* gl = context()->functions();
  gl->glClearColor(0.87F, 0.86F, 0.83F, 1);
  gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  drawn_before();
  try {
    const HostCamera eye = camera();
    update_ = view_.update({&eye, 1}, 0);
    view_.render(0);
  } catch (const std::exception& e) {
    told(QString::fromUtf8(e.what()));
  }
  drawn_after();
}

draw::PixelRect CityWidget::pixel_at(const QPoint& at) const {
  const double ratio = devicePixelRatioF();
  return {static_cast<int>(at.x() * ratio), static_cast<int>((height() - 1 - at.y()) * ratio), 1, 1};
}

NodeId CityWidget::add(const std::string& gltf, const QPoint& at) {
  const auto place = place_at(at);
  if (!place) return 0;
  try {
    const ModelFile file = read_model(gltf);
    if (!nodes_) {
      nodes_ = model_->new_nodes();
      added_ = nodes_->add({.name = "Added"});
      view_.show(model_, nodes_);
    }
    const NodeId id =
        add_model(*nodes_, file, {.parent = added_, .placement = upright(model_->frame(), *place), .name = gltf});
    update();
    return id;
  } catch (const std::exception& e) {
    told(QString::fromUtf8(e.what()));
    return 0;
  }
}

FeatureId CityWidget::feature_at(const QPoint& at) {
  FeatureId id = 0;
  makeCurrent();
  view_.pick(0, pixel_at(at), {&id, 1});
  doneCurrent();
  return id;
}

std::optional<Vec3d> CityWidget::place_at(const QPoint& at) {
  const draw::PixelRect pixel = pixel_at(at);
  makeCurrent();
  const auto place = view_.place(0, pixel.x, pixel.y);
  doneCurrent();
  return place;
}

void CityWidget::mousePressEvent(QMouseEvent* event) {
  last_ = event->pos();
  moved_ = false;
}

void CityWidget::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton) return pointed(event->pos());
  const QPoint step = event->pos() - last_;
  last_ = event->pos();
  moved_ = true;
  if ((event->buttons() & Qt::RightButton) != 0) {
    const double metres = distance_ / height();
    const Vec3d right(std::cos(yaw_), std::sin(yaw_), 0), ahead(-std::sin(yaw_), std::cos(yaw_), 0);
    target_ += metres * (static_cast<double>(step.y()) * ahead - static_cast<double>(step.x()) * right);
  } else {
    yaw_ -= 0.007 * step.x();
    pitch_ = std::clamp(pitch_ - 0.007 * step.y(), -1.55, -0.03);
  }
  update();
}

void CityWidget::mouseReleaseEvent(QMouseEvent* event) {
  if (!moved_) clicked(event->pos());
}

void CityWidget::wheelEvent(QWheelEvent* event) {
  distance_ = std::clamp(distance_ * std::pow(0.999, event->angleDelta().y()), 5.0, 20000.0);
  update();
}

}  // namespace manzana::qt
