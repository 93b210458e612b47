#include "core/base/parallel.h"

#include <sys/mman.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <latch>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace kinemesh {
namespace {

using Limit = tbb::global_control;

// Where TBB finds no memory for a task, it waits for it for ever. So all it needs is taken where there is
// plenty.
constexpr std::size_t plenty = std::size_t{8} << 20;  // bytes
constexpr int tasks_kept = 4;  // for each other thread: as many as loops within loops take

bool has_plenty() {
  void* const memory = mmap(nullptr, plenty, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory != MAP_FAILED && munmap(memory, plenty) == 0;
}

// TBB keeps the memory of these tasks for the next ones of this thread.
void take_memory(int threads) {
  tbb::task_group tasks;
  for (int i = 0; i < tasks_kept * threads; ++i) tasks.run([] {});
  tasks.wait();
}

// Work for one thread besides the one that asks for it.
struct Place {
  tbb::task_arena arena{2};
  tbb::task_group work;
};

void wait_until(const std::atomic<int>& counter, int n) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
  while (counter < n && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

// Makes TBB start threads until there are n, or the system gives no more; returns how many there are. n and
// the result count the calling thread. One after the other, and by this thread: here a failure is an
// exception, but the end of the process where one of TBB's own threads starts the next.
int start_threads(int n) {
  std::latch end(1);
  std::atomic<int> ready{1};
  std::vector<std::unique_ptr<Place>> places;
  int started = 1;
  try {
    while (started < n && has_plenty()) {
      Place& place = *places.emplace_back(std::make_unique<Place>());
      place.arena.execute([&] {
        place.work.run([&] {
          take_memory(n);
          ++ready;
          end.wait();
        });
      });
      wait_until(ready, ++started);
    }
  } catch (const std::exception&) {  // no thread, or no memory to ask for one
  }
  end.count_down();
  for (const auto& place : places) place->arena.execute([&] { place->work.wait(); });
  return started;
}

std::atomic<std::size_t> prepared_for{1};  // so many allowed threads

void prepare(std::size_t allowed) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (allowed <= prepared_for) return;
  static const tbb::task_scheduler_handle keeper{tbb::attach{}};  // of the threads
  const int most = std::max(tbb::info::default_concurrency(), tbb::this_task_arena::max_concurrency());
  const int wanted = static_cast<int>(std::min(allowed, static_cast<std::size_t>(most)));
  const int started = start_threads(wanted);
  // As long as the process lives: TBB must not try again.
  if (started < wanted) (void)new Limit(Limit::max_allowed_parallelism, static_cast<std::size_t>(started));
  prepared_for = allowed;
}

// That may work on something cut into so many parts.
int threads_for(int parts) {
  const std::size_t allowed = Limit::active_value(Limit::max_allowed_parallelism);
  if (allowed <= 1) return 1;
  if (allowed > prepared_for.load(std::memory_order_acquire)) {
    prepare(allowed);
    return threads_for(parts);
  }
  thread_local bool has_memory = false;
  const int here = tbb::this_task_arena::max_concurrency();
  if (!has_memory && here > 1) {
    if (!has_plenty()) return 1;
    take_memory(here);
    has_memory = true;
  }
  return static_cast<int>(
      std::min({static_cast<std::size_t>(parts), allowed, static_cast<std::size_t>(here)}));
}

// The parts go in order to whoever asks for the next. The counters say to the thread sanitizer, which does
// not see into TBB, what is written before what.
class Loop {
 public:
  Loop(int parts, void (*do_part)(const void*, int), const void* body)
      : parts_(parts), do_part_(do_part), body_(body) {}

  void run(int threads) {
    next_.store(0, std::memory_order_release);
    if (threads == 1)
      work();
    else
      tbb::this_task_arena::isolate([&] { share(threads - 1); });
    if (error_) std::rethrow_exception(error_);
  }

 private:
  // Waiting threads do no other work, isolated: that of an outer loop would find the part they are in half
  // done.
  void share(int others) {
    tbb::task_group group;
    for (int i = 0; i < others; ++i) {
      group.run([this] {
        work();
        done_.fetch_add(1, std::memory_order_release);
      });
    }
    work();
    group.wait();
    done_.load(std::memory_order_acquire);
  }

  // No exception reaches TBB, which would need memory for it.
  void work() noexcept {
    for (int part; (part = next_.fetch_add(1, std::memory_order_acq_rel)) < parts_;) {
      try {
        do_part_(body_, part);
      } catch (...) {
        fail(part);
      }
    }
  }

  void fail(int part) {
    const std::lock_guard lock(failing_);
    next_ = parts_;
    if (part > failed_part_) return;
    failed_part_ = part;
    error_ = std::current_exception();
  }

  int parts_;
  void (*do_part_)(const void* body, int part);
  const void* body_;
  std::atomic<int> next_{0}, done_{0};
  std::mutex failing_;
  int failed_part_ = std::numeric_limits<int>::max();
  std::exception_ptr error_;
};

}  // namespace

void do_parts(int parts, void (*do_part)(const void* body, int part), const void* body) {
  Loop(parts, do_part, body).run(threads_for(parts));
}

}  // namespace kinemesh
