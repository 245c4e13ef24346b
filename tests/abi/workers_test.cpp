// Work that comes in pieces, on the caller's thread and those beside it.
#include "workers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace rg::test {
namespace {

TEST(Workers, doEachPieceOnce) {
  Workers workers;
  for (const size_t threads : {0u, 1u, 3u, 7u, 2u, 0u}) {
    workers.keep(threads);
    ASSERT_EQ(workers.threads(), threads);
    for (size_t pieces = 0; pieces < 200; ++pieces) {
      std::vector<int> done(pieces, 0);
      workers.share(pieces, [&](size_t i) { ++done[i]; });
      ASSERT_EQ(std::accumulate(done.begin(), done.end(), 0), static_cast<int>(pieces));
      ASSERT_TRUE(std::ranges::all_of(done, [](int n) { return n == 1; }));
    }
  }
}

TEST(Workers, throwWhatAPieceThrewOnceTheOthersAreDone) {
  Workers workers;
  workers.keep(2);
  for (int round = 0; round < 100; ++round) {
    std::atomic<int> done = 0;
    const auto work = [&](size_t i) {
      if (i == 3) throw std::runtime_error("the fourth");
      ++done;
    };
    EXPECT_THROW(workers.share(20, work), std::runtime_error);
    EXPECT_EQ(done, 19);
  }
  EXPECT_NO_THROW(workers.share(5, [](size_t) {}));
}

// Of as many pieces as there are threads, which wait for each other, each has one. One alone would wait for
// ever, and says so after a while.
template <class Look>
void onEachThread(Workers& workers, const Look& look) {
  std::mutex mutex;
  std::condition_variable came;
  size_t here = 0, met = 0;
  const size_t all = workers.threads() + 1;
  workers.share(all, [&](size_t) {
    std::unique_lock lock(mutex);
    ++here;
    came.notify_all();
    met += came.wait_for(lock, std::chrono::seconds(60), [&] { return here == all; }) ? 1u : 0u;
    look();
  });
  EXPECT_EQ(met, all);
}

TEST(Workers, areAllAtWorkAtOnce) {
  Workers workers;
  workers.keep(3);
  onEachThread(workers, [] {});
}

TEST(Workers, roundAsTheCallerDoes) {
  Workers workers;
  workers.keep(2);
  for (const int mode : {FE_UPWARD, FE_TONEAREST}) {
    std::fesetround(mode);
    int as_told = 0;
    onEachThread(workers, [&] { as_told += std::fegetround() == mode ? 1 : 0; });
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(as_told, 3);
  }
}

TEST(Workers, leaveTheHostsSignalsToTheHost) {
  Workers workers;
  workers.keep(2);
  int blocked = 0, own = 0;
  sigset_t term;
  sigemptyset(&term);
  sigaddset(&term, SIGTERM);
  pthread_sigmask(SIG_UNBLOCK, &term, nullptr);
  onEachThread(workers, [&] {
    sigset_t now;
    pthread_sigmask(SIG_SETMASK, nullptr, &now);
    blocked += sigismember(&now, SIGTERM) == 1 ? 1 : 0;
    own += sigismember(&now, SIGSEGV) == 0 ? 1 : 0;
  });
  EXPECT_EQ(blocked, 2);  // not the caller's
  EXPECT_EQ(own, 3);
}

}  // namespace
}  // namespace rg::test
