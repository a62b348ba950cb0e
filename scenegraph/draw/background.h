#pragma once
/// Things that are made when they are asked for, one after the other, beside what is drawn: on a host's threads, or on
/// one of its own, which is there only while there is something to make.
///   Background<std::uint32_t, Pack> packs([](std::uint32_t plant) { return make(plant); });
///   packs.want(plant);                                              // any time
///   while (auto made = packs.take()) use(made->key, made->value);
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

namespace manzana::draw {

/// Runs a task, once: some time on another thread, or at once.
using Run = std::function<void(std::function<void()> task)>;

template <class Key, class Value>
class Background {
 public:
  struct Made {
    Key key;
    Value value;
  };
  /// None: it cannot be made, and is not tried again. Throws nothing.
  using Make = std::function<std::optional<Value>(const Key&)>;

  /// With `run`, `make` must own what it uses: a task that has begun ends when it likes. `arrived` is called, on the
  /// task's thread, for each that is made, never after drop(); it must not come back here.
  explicit Background(Make make, Run run = {}, std::function<void()> arrived = {})
      : work_(std::make_shared<Work>(std::move(make), std::move(arrived))), run_(std::move(run)) {}
  ~Background() { drop(); }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Each key is made once, whoever asks how often, until it has been taken.
  void want(const Key& key) {
    {
      const std::scoped_lock lock(work_->mutex);
      if (!work_->known.insert(key).second) return;
      work_->todo.push_back(key);
      if (std::exchange(work_->busy, true)) return;
    }
    start();
  }

  /// Of those that are done.
  std::optional<Made> take() {
    const std::scoped_lock lock(work_->mutex);
    return work_->take();
  }
  /// None: all that are wanted have been taken, or cannot be made.
  std::optional<Made> wait_and_take() {
    std::unique_lock lock(work_->mutex);
    work_->changed.wait(lock, [&] { return !work_->done.empty() || !work_->busy; });
    return work_->take();
  }
  /// What was wanted is so no longer. Waits for what is at hand on a thread of its own, not for a host's.
  void drop() {
    {
      const std::scoped_lock lock(work_->mutex);
      ++work_->round;
      work_->known.clear();
      work_->todo.clear();
      work_->done.clear();
    }
    if (thread_.joinable()) thread_.join();
  }
  bool ready() const {
    const std::scoped_lock lock(work_->mutex);
    return !work_->done.empty();
  }
  /// Asked for, and not yet taken.
  std::size_t left() const {
    const std::scoped_lock lock(work_->mutex);
    return work_->todo.size() + work_->done.size() + (work_->making ? 1 : 0);
  }

 private:
  struct Work {
    Work(Make m, std::function<void()> a) : make(std::move(m)), arrived(std::move(a)) {}

    std::optional<Made> take() {
      if (done.empty()) return std::nullopt;
      std::optional<Made> made(std::move(done.front()));
      done.pop_front();
      known.erase(made->key);
      return made;
    }

    void make_all() {
      std::unique_lock lock(mutex);
      for (; !todo.empty(); changed.notify_all()) {
        const Key key = todo.front();
        const std::uint64_t wanted_in = round;
        todo.pop_front();
        making = true;
        lock.unlock();
        std::optional<Value> value = make(key);
        lock.lock();
        making = false;
        if (!value || wanted_in != round) continue;
        done.push_back({key, std::move(*value)});
        if (arrived) arrived();
      }
      busy = false;
      changed.notify_all();
    }

    const Make make;
    const std::function<void()> arrived;
    std::mutex mutex;  ///< of all below
    std::condition_variable changed;
    std::set<Key> known;
    std::deque<Key> todo;
    std::deque<Made> done;
    std::uint64_t round = 0;  ///< what was wanted in an earlier one is dropped
    bool busy = false, making = false;
  };

  void start() {
    if (run_) return run_([work = work_] { work->make_all(); });
    if (thread_.joinable()) thread_.join();  // it has nothing left to do
    thread_ = std::thread([work = work_] { work->make_all(); });
  }

  std::shared_ptr<Work> work_;
  Run run_;
  std::thread thread_;
};

}  // namespace manzana::draw
