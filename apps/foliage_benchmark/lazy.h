#pragma once
/// Made when it is first asked for.
///   Lazy<Stage> stage([&] { return Stage(plants, sites); });
///   stage->draw(...);
#include <functional>
#include <memory>
#include <utility>

namespace manzana::foliage_benchmark {

template <class T>
class Lazy {
 public:
  explicit Lazy(std::function<T()> make) : make_(std::move(make)) {}
  T& operator*() {
    if (!value_) value_.reset(new T(make_()));
    return *value_;
  }
  T* operator->() { return &**this; }

 private:
  std::function<T()> make_;
  std::unique_ptr<T> value_;
};

}  // namespace manzana::foliage_benchmark
