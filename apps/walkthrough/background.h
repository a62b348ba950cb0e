#pragma once
/// Things that are made when they are asked for, one after the other, on a thread of their own.
///   Background<std::uint32_t, Pack> packs([&](std::uint32_t plant) { return make(plant); });
///   packs.want(keys);                                               // any time
///   while (auto made = packs.take()) use(made->key, made->value);
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <thread>

namespace manzana::walkthrough {

template <class Key, class Value>
class Background {
 public:
  struct Made {
    Key key;
    Value value;
  };
  /// None: it cannot be made, and is not tried again.
  using Make = std::function<std::optional<Value>(const Key&)>;

  explicit Background(Make make) : make_(std::move(make)), thread_([this] { work(); }) {}
  /// Waits for what is at hand.
  ~Background() {
    {
      const std::scoped_lock lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Each key is made once, whoever asks how often, until it has been taken.
  void want(std::span<const Key> keys) {
    if (keys.empty()) return;
    const std::scoped_lock lock(mutex_);
    for (const Key& key : keys)
      if (known_.insert(key).second) todo_.push_back(key);
    changed_.notify_all();
  }

  /// Of those that are done.
  std::optional<Made> take() {
    const std::scoped_lock lock(mutex_);
    return take_locked();
  }
  /// None: all that are wanted have been taken, or cannot be made.
  std::optional<Made> wait_and_take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !done_.empty() || (todo_.empty() && !busy_); });
    return take_locked();
  }

 private:
  std::optional<Made> take_locked() {
    if (done_.empty()) return std::nullopt;
    std::optional<Made> made(std::move(done_.front()));
    done_.pop_front();
    known_.erase(made->key);
    return made;
  }

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return stop_ || !todo_.empty(); });
      if (stop_) return;
      const Key key = todo_.front();
      todo_.pop_front();
      busy_ = true;
      lock.unlock();
      std::optional<Value> value = make_(key);
      lock.lock();
      busy_ = false;
      if (value) done_.push_back({key, std::move(*value)});
      changed_.notify_all();
    }
  }

  Make make_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<Key> known_;
  std::deque<Key> todo_;
  std::deque<Made> done_;
  bool busy_ = false, stop_ = false;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace manzana::walkthrough
