#include "fxsdk/cli/import/child_process.h"

#include "fxsdk/cli/support/interrupt.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FX_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define FX_SANITIZED 1
#endif
#endif

namespace fx::cli {
namespace {

using base::Code;
using base::Status;

constexpr int kPollMilliseconds = 100; // between two looks at Ctrl-C
constexpr unsigned kClockFactor = 2;   // a child that waits uses no processor time
constexpr uint64_t kMostMessage = 1 << 16;

/// Of a result, before its bytes.
struct Header
{
    int64_t code;
    uint64_t messageBytes;
    uint64_t bytes;
};

class Descriptor
{
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor() { reset(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    void reset()
    {
        if (number_ >= 0)
            ::close(number_);
        number_ = -1;
    }
    int number() const { return number_; }

private:
    int number_;
};

void limit(__rlimit_resource resource, uint64_t value)
{
    rlimit now{};
    if (getrlimit(resource, &now) == 0)
        value = std::min<uint64_t>(value, now.rlim_max);
    const rlimit wanted{value, value};
    static_cast<void>(setrlimit(resource, &wanted));
}

/// Limits the addresses beyond those in use. Not with sanitizers, which reserve terabytes of addresses.
void limitAddresses([[maybe_unused]] uint64_t more)
{
#ifndef FX_SANITIZED
    std::ifstream file("/proc/self/statm");
    uint64_t pages = 0;
    file >> pages;
    limit(RLIMIT_AS, pages * uint64_t(sysconf(_SC_PAGESIZE)) + more);
#endif
}

void applyLimits(const ChildLimits& limits)
{
    limitAddresses(limits.memory);
    limit(RLIMIT_CPU, limits.seconds);
    limit(RLIMIT_FSIZE, limits.output + kMostMessage + sizeof(Header));
    limit(RLIMIT_CORE, 0);
}

bool writeAll(int descriptor, const void* data, size_t size)
{
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::write(descriptor, at, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        at += written;
        size -= size_t(written);
    }
    return true;
}

/// Does not return.
[[noreturn]] void runChild(const ChildLimits& limits, pid_t parent, int target,
                           const std::function<Status(std::string&)>& work)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) // it ended before the line above
        _exit(1);
    for (const int number : {SIGINT, SIGTERM, SIGALRM})
        std::signal(number, SIG_DFL);
    alarm(0);
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        dup2(nothing, standard);
    applyLimits(limits);
    std::string bytes;
    Status status;
    try {
        status = work(bytes);
    } catch (const std::exception& error) {
        status = {Code::Internal, error.what()};
    }
    const std::string& message = status.message();
    const Header header{int64_t(status.code()), std::min<uint64_t>(message.size(), kMostMessage),
                        status.ok() ? bytes.size() : 0};
    const bool isWritten = writeAll(target, &header, sizeof header) &&
                           writeAll(target, message.data(), header.messageBytes) &&
                           writeAll(target, bytes.data(), header.bytes);
    _exit(isWritten ? 0 : 1);
}

/// Waits until `pipe` is closed, which is when the child ends.
enum class Ending
{
    ByItself,
    TooSlow,
    Interrupted
};

Ending waitFor(int pipe, unsigned seconds)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    while (std::chrono::steady_clock::now() < end) {
        if (interruptRequested())
            return Ending::Interrupted;
        pollfd state{pipe, POLLIN, 0};
        if (poll(&state, 1, kPollMilliseconds) > 0)
            return Ending::ByItself;
    }
    return Ending::TooSlow;
}

base::Result<std::string> readResult(int source)
{
    const Status damaged(Code::Internal, "the process that read the file gave no result");
    const off_t size = lseek(source, 0, SEEK_END);
    Header header{};
    if (size < off_t(sizeof header) || pread(source, &header, sizeof header, 0) != ssize_t(sizeof header))
        return damaged;
    const uint64_t rest = uint64_t(size) - sizeof header;
    if (header.messageBytes > rest || header.bytes != rest - header.messageBytes)
        return damaged;
    std::string message(header.messageBytes, '\0'), bytes(header.bytes, '\0');
    const auto fill = [&](std::string& io, uint64_t at) {
        for (size_t done = 0; done < io.size();) {
            const ssize_t got = pread(source, io.data() + done, io.size() - done, off_t(at + done));
            if (got <= 0)
                return false;
            done += size_t(got);
        }
        return true;
    };
    if (!fill(message, sizeof header) || !fill(bytes, sizeof header + header.messageBytes))
        return damaged;
    if (header.code != 0)
        return Status(Code(header.code), message);
    return bytes;
}

Status failed(const char* what)
{
    return {Code::Io, std::string(what) + ": " + std::strerror(errno)};
}

std::string secondsText(unsigned seconds)
{
    return "took more than " + std::to_string(seconds) + " s";
}

} // namespace

base::Result<std::string> runInChild(const ChildLimits& limits,
                                     const std::function<Status(std::string&)>& work, ChildReport* outReport)
{
    const Descriptor result(memfd_create("fx-child", MFD_CLOEXEC));
    int ends[2];
    if (result.number() < 0 || pipe2(ends, O_CLOEXEC) != 0)
        return failed("cannot create a process to read the file");
    const Descriptor alive(ends[0]);
    Descriptor held(ends[1]);
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0)
        return failed("cannot create a process to read the file");
    if (child == 0)
        runChild(limits, parent, result.number(), work);
    const EndsWithProgram registered(child);
    held.reset();
    const Ending ending = waitFor(alive.number(), limits.seconds * kClockFactor);
    if (ending != Ending::ByItself)
        kill(child, SIGKILL);
    int status = 0;
    rusage use{};
    while (wait4(child, &status, 0, &use) < 0 && errno == EINTR)
        continue;
    ChildReport report;
    report.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    report.wasTooSlow = ending == Ending::TooSlow || report.signal == SIGXCPU ||
                        (report.signal == SIGKILL && ending == Ending::ByItself &&
                         unsigned(use.ru_utime.tv_sec + use.ru_stime.tv_sec) + 1 >= limits.seconds);
    report.peakMemory = uint64_t(use.ru_maxrss) * 1024;
    report.seconds = double(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
                     1e-6 * double(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
    if (outReport)
        *outReport = report;
    if (ending == Ending::Interrupted)
        return interruptedStatus();
    if (report.wasTooSlow)
        return Status(Code::TooLarge, secondsText(limits.seconds));
    if (report.signal == SIGXFSZ)
        return Status(Code::TooLarge,
                      "has more than " + std::to_string(limits.output >> 20) + " MiB of voxels");
    if (report.signal != 0)
        return Status(Code::Parse, std::string("was stopped by the signal ") + std::to_string(report.signal) +
                                       " (" + strsignal(report.signal) + ")");
    return readResult(result.number());
}

} // namespace fx::cli
