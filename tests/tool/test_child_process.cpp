#include "fxsdk/cli/import/child_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <unistd.h>
#include <vector>

namespace fx::cli {
namespace {

using base::Code;
using base::Status;

TEST(ChildProcess, resultsAndErrorsComeBack)
{
    const std::string large(5'000'000, 'x');
    const auto done = runInChild({}, [&](std::string& out) {
        out = large;
        return Status();
    });
    ASSERT_TRUE(done.ok()) << done.status().message();
    EXPECT_EQ(*done, large);
    const auto failed = runInChild({}, [](std::string&) { return Status(Code::Schema, "a frustum"); });
    EXPECT_EQ(failed.status().code(), Code::Schema);
    EXPECT_EQ(failed.status().message(), "a frustum");
}

TEST(ChildProcess, aCrashIsAnErrorWithItsSignal)
{
    ChildReport report;
    const auto crashed = runInChild(
        {},
        [](std::string&) {
            std::signal(SIGSEGV, SIG_DFL); // not the one of a sanitizer
            static_cast<void>(raise(SIGSEGV));
            return Status();
        },
        &report);
    EXPECT_EQ(crashed.status().code(), Code::Parse);
    EXPECT_EQ(report.signal, SIGSEGV);
}

TEST(ChildProcess, timeIsLimited)
{
    ChildLimits limits;
    limits.seconds = 1;
    ChildReport report;
    const auto busy = runInChild(
        limits,
        [](std::string&) {
            volatile bool isBusy = true;
            while (isBusy) {
            }
            return Status();
        },
        &report);
    EXPECT_EQ(busy.status().code(), Code::TooLarge);
    EXPECT_TRUE(report.wasTooSlow);
    const auto idle = runInChild(
        limits,
        [](std::string&) {
            sleep(1000);
            return Status();
        },
        &report);
    EXPECT_EQ(idle.status().code(), Code::TooLarge);
    EXPECT_TRUE(report.wasTooSlow);
}

TEST(ChildProcess, sizeOfTheResultIsLimited)
{
    ChildLimits limits;
    limits.output = 1 << 20;
    const auto result = runInChild(limits, [](std::string& out) {
        out.assign(8 << 20, 'x');
        return Status();
    });
    EXPECT_EQ(result.status().code(), Code::TooLarge);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ChildProcess, memoryIsLimited)
{
    ChildLimits limits;
    limits.memory = 64 << 20;
    const auto allocate = [](size_t bytes) {
        return [bytes](std::string&) -> Status {
            try {
                const std::vector<char> large(bytes, 'x');
                return large[bytes / 2] == 'x' ? Status() : Status(Code::Internal, "");
            } catch (const std::bad_alloc&) {
                return {Code::OutOfMemory, "too much"};
            }
        };
    };
    EXPECT_TRUE(runInChild(limits, allocate(16 << 20)).ok());
    EXPECT_EQ(runInChild(limits, allocate(size_t(512) << 20)).status().code(), Code::OutOfMemory);
}
#endif

} // namespace
} // namespace fx::cli
