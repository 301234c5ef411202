// One signal stops the program, whether its work looks for it or not, and nothing temporary outlives it.
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "tests/tool/temporary_folder.h"

#include <chrono>
#include <csignal>
#include <functional>
#include <sys/wait.h>
#include <thread>

namespace fx::cli {
namespace {

using test::TemporaryFolder;

constexpr int kGoesOn = 77; ///< exit code of a program that nothing has stopped

/// Work that looks at nothing for as long as the patience of any user.
void workOn()
{
    std::this_thread::sleep_for(std::chrono::milliseconds(100)); // a signal may end that early
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < std::chrono::seconds(120))
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    _exit(kGoesOn);
}

/// Runs `body` in a process of its own, which has a second to stop. @return its exit code, or minus the
/// signal that ended it
int exitCodeOf(const std::function<void()>& body)
{
    const pid_t child = fork();
    if (child == 0) {
        installInterruptHandler(1);
        body();
        _exit(kSuccess);
    }
    int state = 0;
    EXPECT_EQ(waitpid(child, &state, 0), child);
    return WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
}

} // namespace

TEST(Interrupt, oneSignalStopsWorkThatDoesNotLook)
{
    for (const int signal : {SIGTERM, SIGINT})
        EXPECT_EQ(exitCodeOf([signal] {
                      raise(signal);
                      workOn();
                  }),
                  kInterrupted);
}

TEST(Interrupt, aSecondSignalStopsAtOnce)
{
    EXPECT_EQ(exitCodeOf([] {
                  raise(SIGTERM);
                  (void)interruptRequested(); // it is on its way out, which may take long
                  raise(SIGTERM);
                  _exit(kGoesOn);
              }),
              kInterrupted);
}

TEST(Interrupt, workThatLooksEndsInItsOwnWay)
{
    EXPECT_EQ(exitCodeOf([] {
                  if (interruptRequested())
                      _exit(kFailed);
                  raise(SIGTERM);
                  if (!interruptRequested())
                      _exit(kFailed);
                  std::this_thread::sleep_for(std::chrono::milliseconds(1500)); // longer than it had to look
                  std::this_thread::sleep_for(std::chrono::milliseconds(1500)); // one is cut by the alarm
              }),
              kSuccess);
}

TEST(Interrupt, temporaryFilesAndChildrenDoNotOutliveTheProgram)
{
    const TemporaryFolder folder;
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    EXPECT_EQ(exitCodeOf([&] {
                  AtomicFile kept(folder / "kept.txt"), lost(folder / "lost.txt");
                  if (!kept.open().ok() || !kept.commit().ok() || !lost.open().ok() ||
                      !lost.write("half").ok())
                      _exit(kFailed);
                  const pid_t child = fork();
                  if (child == 0) // holds the pipe open as long as it lives
                      workOn();
                  close(ends[1]);
                  const EndsWithProgram entered(child);
                  raise(SIGTERM);
                  workOn();
              }),
              kInterrupted);
    EXPECT_EQ(folder.entries(), 1u);
    close(ends[1]);
    char byte = 0;
    EXPECT_EQ(read(ends[0], &byte, 1), 0); // the end of the file: the child is gone
    close(ends[0]);
}

TEST(Interrupt, whatHasEndedIsForgotten)
{
    const TemporaryFolder folder;
    test::writeText(folder / "other.txt", "of somebody else, by now");
    EXPECT_EQ(exitCodeOf([&] {
                  for (int i = 0; i < 100; ++i) { // more than can be entered at a time
                      EndsWithProgram one((folder / "other.txt").string());
                      EndsWithProgram moved = std::move(one);
                  }
                  raise(SIGTERM);
                  workOn();
              }),
              kInterrupted);
    EXPECT_EQ(folder.entries(), 1u);
}

} // namespace fx::cli
