#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "lib/core/parallel.h"
#include "tests/catch.h"

namespace bp::test {

TEST_CASE("a loop in a pipeline runs to its end though another item fails meanwhile", "[quick][core]") {
  std::atomic<int> next{0}, halves{0};
  std::atomic<bool> looping{false};
  const auto produce = [&](int& item) {
    item = next++;
    return item < 2;
  };
  const auto work = [&](const int& item) {
    using namespace std::chrono_literals;
    if (item == 1) {
      for (int i = 0; i < 1000 && !looping; ++i) std::this_thread::sleep_for(1ms);
      throw std::runtime_error("item 1");
    }
    std::atomic<int> done{0};
    parallel_for(200, [&](std::int64_t) {
      looping = true;
      std::this_thread::sleep_for(1ms);
      ++done;
    });
    halves += done != 200;
  };
  for (int i = 0; i < 5; ++i) {
    next = 0;
    looping = false;
    CHECK_THROWS_AS(pipeline<int>(2, produce, work, [](int&) {}), std::runtime_error);
  }
  CHECK(halves == 0);
}

TEST_CASE("the exception of a loop reaches the caller", "[quick][core]") {
  CHECK_THROWS_AS(parallel_for(100,
                               [](std::int64_t i) {
                                 if (i == 57) throw std::runtime_error("57");
                               }),
                  std::runtime_error);
}

TEST_CASE("items that a failing pipeline leaves behind are destroyed", "[quick][core]") {
  static std::atomic<int> alive{0};
  struct Item {
    int number = 0;
    Item() { ++alive; }
    ~Item() { --alive; }
    Item(const Item&) = delete;
    Item& operator=(const Item&) = delete;
  };
  int next = 0;
  const auto produce = [&](Item& item) { return (item.number = next++) < 100; };
  const auto fail_at_7 = [](const Item& item) {
    if (item.number == 7) throw std::runtime_error("7");
  };
  CHECK_THROWS(pipeline<Item>(
      4, produce, [](Item&) {}, fail_at_7));
  CHECK(alive == 0);
  next = 0;
  CHECK_THROWS(run_jobs<Item>(4, produce, fail_at_7));
  CHECK(alive == 0);
}

TEST_CASE("work in an arena has the arena's threads, on each of them", "[quick][core]") {
  const int before = thread_count();
  WorkArena(1).run([&] {
    CHECK(thread_count() == 1);
    std::atomic<int> others{0};
    parallel_for(100, [&](std::int64_t) { others += thread_count() != 1; });
    CHECK(others == 0);
    WorkArena(0).run([&] { CHECK(thread_count() >= 1); });
    CHECK(thread_count() == 1);
  });
  CHECK(thread_count() == before);
}

TEST_CASE("work that is told to stop throws Cancelled, and other work goes on", "[quick][core]") {
  std::atomic<bool> stop{false};
  std::atomic<int> done{0};
  WorkArena arena(0, &stop);
  const auto loop = [&] {
    parallel_for(100000, [&](std::int64_t) {
      if (++done == 10) stop = true;
    });
  };
  CHECK_THROWS_AS(arena.run(loop), Cancelled);
  CHECK(done < 100000);
  CHECK_THROWS_AS(arena.run([] { stop_if_asked(); }), Cancelled);
  CHECK_NOTHROW(stop_if_asked());
  CHECK_NOTHROW(loop());
  int next = 0;
  stop = false;
  CHECK_THROWS_AS(arena.run([&] {
    pipeline<int>(
        3, [&](int& item) { return (item = next++) < 1000; }, [&](int& item) { stop = stop || item == 7; },
        [](int&) {});
  }),
                  Cancelled);
  CHECK(next < 1000);
}

namespace {

/// Returns whether loops and pipelines do all of their work, on this thread alone.
bool works_alone() {
  const std::thread::id here = std::this_thread::get_id();
  int done = 0, sum = 0, next = 0;
  const auto count = [&] { done += std::this_thread::get_id() == here; };
  const auto produce = [&](int& item) { return (item = next++) < 50; };
  WorkArena(2).run([&] {
    parallel_for(50, [&](std::int64_t) { count(); });
    isolated([&] { parallel_ranges(50, 7, [&](std::int64_t begin, std::int64_t end) { done += int(end - begin); }); });
    pipeline<int>(
        3, produce, [&](int&) { count(); }, [&](const int& item) { sum += item; });
    next = 0;
    run_jobs<int>(3, produce, [&](int&) { count(); });
  });
  return thread_count() == 1 && done == 200 && sum == 49 * 50 / 2;
}

}  // namespace

TEST_CASE("side work is done when it is waited for, with any number of threads", "[quick][core]") {
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    std::vector<SideWork> ring(3);
    std::vector<int> done(50, 0);
    for (std::size_t i = 0; i < done.size(); ++i) {
      ring[i % 3].wait();
      CHECK((i < 3 || done[i - 3] == 1));
      ring[i % 3].begin([&done, i] { done[i] = 1; });
    }
    for (SideWork& work : ring) work.wait();
    CHECK(std::count(done.begin(), done.end(), 1) == 50);
    CHECK_NOTHROW(ring[0].wait());
  }
}

TEST_CASE("the exception of side work reaches who waits for it, and is dropped with the object", "[quick][core]") {
  SideWork work;
  work.begin([] { throw std::runtime_error("aside"); });
  CHECK_THROWS_AS(work.wait(), std::runtime_error);
  CHECK_NOTHROW(work.wait());
  std::atomic<bool> ran{false};
  {
    SideWork dropped;
    dropped.begin([&] {
      ran = true;
      throw std::runtime_error("nobody waits");
    });
  }
  CHECK(ran);
}

TEST_CASE("a child of fork() does all work on its only thread", "[quick][core]") {
  parallel_for(100, [](std::int64_t) {});
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(60);  // a child that waits for threads of its parent ends by a signal
    ::_exit(works_alone() ? 0 : 1);
  }
  REQUIRE(child > 0);
  int status = -1;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}

TEST_CASE("the number of threads is that of the smallest limit, and of all cores again without one", "[quick][core]") {
  const int all = thread_count();
  {
    const ThreadLimit three(3);
    CHECK(thread_count() == 3);
    {
      const ThreadLimit two(2);
      CHECK(thread_count() == 2);
    }
    CHECK(thread_count() == 3);
  }
  CHECK(thread_count() == all);
}

}  // namespace bp::test
