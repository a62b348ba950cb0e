#!/usr/bin/env python3
"""A city in a PyQt window, through libmanzana.so and ctypes: as a plugin of a GIS program would embed it.

    manzana_viewer.py [CITY] [--library libmanzana.so] [--screenshot FILE.png]

Drag turns, the wheel comes nearer, a click says what is there."""
import argparse
import ctypes as c
import math
import sys
import threading

from PyQt5 import QtCore, QtGui, QtWidgets

KINDS = {1: "building", 2: "ground", 4: "tree"}


class Error(c.Structure):
    _fields_ = [("text", c.c_char * 512)]


class Camera(c.Structure):
    _fields_ = [("projection", c.c_double * 16), ("view", c.c_double * 16), ("depth", c.c_int32)] + [
        (name, c.c_int32) for name in ("x", "y", "width", "height")]


class Update(c.Structure):
    _fields_ = [("bytes_to_upload", c.c_uint64), ("far_trees_left", c.c_uint64), ("pictures_left", c.c_uint64),
                ("gpu_bytes", c.c_uint64), ("shown", c.c_int32)]


class Feature(c.Structure):
    _fields_ = [("id", c.c_uint32), ("kind", c.c_uint32), ("low", c.c_double * 3), ("high", c.c_double * 3),
                ("geo", c.c_double * 3)]


Repaint = c.CFUNCTYPE(None, c.c_void_p)


class Host(c.Structure):
    _fields_ = [("user", c.c_void_p), ("log", c.c_void_p), ("request_repaint", Repaint), ("get_proc_address", c.c_void_p),
                ("run", c.c_void_p)]


def load_library(name):
    library = c.CDLL(name)
    for function in ("manzana_model_load", "manzana_view_create", "manzana_model_credits"):
        getattr(library, function).restype = c.c_char_p if function.endswith("credits") else c.c_void_p
    return library


def column_major(matrix):
    return (c.c_double * 16)(*matrix.data())


class CityWidget(QtWidgets.QOpenGLWidget):
    loaded = QtCore.pyqtSignal(object, str)
    repaint_asked = QtCore.pyqtSignal()
    told = QtCore.pyqtSignal(str)

    def __init__(self, library, city):
        super().__init__()
        self.m, self.gl, self.model, self.complete = library, c.CDLL("libGL.so.1"), None, False
        self.failed = False
        self.eye = [0.0, -35.0, 500.0]  # degrees round up, degrees down, metres away
        self.host = Host(request_repaint=Repaint(lambda user: self.repaint_asked.emit()))
        self.view = c.c_void_p(library.manzana_view_create(c.byref(self.host), None))
        self.loaded.connect(self.show_model)
        self.repaint_asked.connect(self.update)
        threading.Thread(target=self.load, args=(city,), daemon=True).start()

    def load(self, city):  # no GL, no Qt: a thread of its own
        error = Error()
        model = self.m.manzana_model_load(city.encode(), None, None, None, c.byref(error))
        self.loaded.emit(model, error.text.decode())

    def show_model(self, model, error):
        if not model:
            self.failed = True
            print(error, file=sys.stderr)
            return self.told.emit(error)
        self.model = c.c_void_p(model)
        self.m.manzana_view_show(self.view, self.model)
        self.told.emit(self.m.manzana_model_credits(self.model).decode())

    def initializeGL(self):
        self.context().aboutToBeDestroyed.connect(self.release)

    def release(self):
        self.makeCurrent()
        self.m.manzana_view_release(self.view)
        self.doneCurrent()

    def camera(self):
        ratio, projection, view = self.devicePixelRatio(), QtGui.QMatrix4x4(), QtGui.QMatrix4x4()
        projection.perspective(50, self.width() / max(1, self.height()), 1, 20000)
        yaw, pitch = math.radians(self.eye[0]), math.radians(self.eye[1])
        away = [math.sin(yaw) * math.cos(pitch), -math.cos(yaw) * math.cos(pitch), -math.sin(pitch)]
        view.lookAt(QtGui.QVector3D(*[self.eye[2] * v for v in away]), QtGui.QVector3D(), QtGui.QVector3D(0, 0, 1))
        return Camera(column_major(projection), column_major(view), 0, 0, 0, int(self.width() * ratio),
                      int(self.height() * ratio))

    def paintGL(self):
        self.gl.glClearColor(c.c_float(0.87), c.c_float(0.86), c.c_float(0.83), c.c_float(1))  # the host's own drawing
        self.gl.glClear(0x4100)
        update, error = Update(), Error()
        self.m.manzana_view_update(self.view, c.byref(self.camera()), c.c_size_t(1), c.c_double(0), c.byref(update), None)
        if not self.m.manzana_view_render(self.view, c.c_size_t(0), c.byref(error)):
            self.told.emit(error.text.decode())
        self.complete = bool(self.m.manzana_view_complete(self.view))

    def mousePressEvent(self, event):
        self.last, self.moved = event.pos(), False

    def mouseMoveEvent(self, event):
        step, self.last, self.moved = event.pos() - self.last, event.pos(), True
        self.eye[0] -= 0.4 * step.x()
        self.eye[1] = min(-2.0, max(-89.0, self.eye[1] - 0.4 * step.y()))
        self.update()

    def wheelEvent(self, event):
        self.eye[2] = min(8000.0, max(10.0, self.eye[2] * 0.999 ** event.angleDelta().y()))
        self.update()

    def mouseReleaseEvent(self, event):
        if not self.moved:
            self.told.emit(self.identify(event.x(), event.y()))

    def identify(self, x, y):
        feature, ids, ratio = Feature(), (c.c_uint32 * 1)(), self.devicePixelRatio()
        self.makeCurrent()
        self.m.manzana_view_pick(self.view, c.c_size_t(0), int(x * ratio), int((self.height() - 1 - y) * ratio), 1, 1, ids,
                                 None)
        self.doneCurrent()
        if not self.model or not self.m.manzana_model_feature(self.model, ids[0], c.byref(feature)):
            return "nothing"
        return "%s %d at %.6f, %.6f, %.1f m high" % (KINDS[feature.kind], feature.id, feature.geo[0], feature.geo[1],
                                                    feature.high[2] - feature.low[2])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("city", nargs="?", default="builtin:town")
    parser.add_argument("--library", default="libmanzana.so")
    parser.add_argument("--screenshot", help="write the window to this file once the city is there, and end")
    options = parser.parse_args()
    form = QtGui.QSurfaceFormat()
    form.setVersion(4, 5)
    form.setProfile(QtGui.QSurfaceFormat.CoreProfile)
    form.setDepthBufferSize(24)
    QtGui.QSurfaceFormat.setDefaultFormat(form)
    application = QtWidgets.QApplication(sys.argv[:1])
    window, city = QtWidgets.QMainWindow(), CityWidget(load_library(options.library), options.city)
    window.setCentralWidget(city)
    window.resize(900, 600)
    window.setWindowTitle("Manzana: " + options.city)
    city.told.connect(window.statusBar().showMessage)
    window.show()
    if options.screenshot:
        def look():
            if city.complete:
                city.told.emit(city.identify(city.width() // 2, city.height() // 2))
                print(window.statusBar().currentMessage())
                window.grab().save(options.screenshot)
                application.quit()
            elif city.failed:
                application.exit(1)
        timer = QtCore.QTimer()
        timer.timeout.connect(look)
        timer.start(100)
    return application.exec_()


if __name__ == "__main__":
    sys.exit(main())
