#include "fxsdk/cli/support/interrupt.h"

#include "fxsdk/cli/support/exit_code.h"

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>
#include <unistd.h>
#include <utility>

namespace fx::cli {
namespace {

/// What ends with the program. A signal handler reads it at any moment.
struct Slot
{
    enum State : int
    {
        Free,
        BeingWritten,
        HasFile,
        HasProcess
    };
    std::atomic<int> state{Free};
    char file[PATH_MAX];
    pid_t process;
};
static_assert(std::atomic<int>::is_always_lock_free);

std::array<Slot, 32> g_slots;
std::atomic<int> g_requested{0};
std::atomic<int> g_heard{0};
unsigned g_secondsToStop = kSecondsToStop;

/// Calls nothing that a signal handler must not.
[[noreturn]] void endProgram()
{
    for (const Slot& slot : g_slots) {
        const int state = slot.state.load();
        if (state == Slot::HasProcess)
            kill(slot.process, SIGKILL);
        if (state == Slot::HasFile)
            unlink(slot.file);
    }
    constexpr char kMessage[] = "fx: interrupted\n";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
    _exit(kInterrupted);
}

void onRequest(int)
{
    if (g_requested.exchange(1) != 0)
        endProgram();
    alarm(g_secondsToStop);
}

void onAlarm(int)
{
    if (g_heard.load() == 0)
        endProgram();
}

/// @return index of a slot that is being written; the number of slots when none is free
size_t takeSlot()
{
    size_t at = 0;
    for (int free = Slot::Free; at < g_slots.size(); ++at, free = Slot::Free)
        if (g_slots[at].state.compare_exchange_strong(free, Slot::BeingWritten))
            break;
    return at;
}

} // namespace

void installInterruptHandler(unsigned secondsToStop)
{
    g_secondsToStop = secondsToStop;
    struct sigaction action = {};
    sigemptyset(&action.sa_mask);
    action.sa_handler = onRequest;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    action.sa_handler = onAlarm;
    sigaction(SIGALRM, &action, nullptr);
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, nullptr); // writing beyond `ulimit -f` is an error like a full disk
    sigaction(SIGPIPE, &action, nullptr);
}

bool interruptRequested()
{
    if (g_requested.load(std::memory_order_relaxed) == 0)
        return false;
    g_heard.store(1);
    return true;
}

base::Status interruptedStatus()
{
    return {base::Code::Interrupted, "interrupted"};
}

EndsWithProgram::EndsWithProgram(const std::string& file)
{
    const size_t at = file.size() < sizeof Slot::file ? takeSlot() : g_slots.size();
    if (at == g_slots.size())
        return;
    std::memcpy(g_slots[at].file, file.c_str(), file.size() + 1);
    g_slots[at].state.store(Slot::HasFile);
    slot_ = at;
}

EndsWithProgram::EndsWithProgram(pid_t process)
{
    const size_t at = takeSlot();
    if (at == g_slots.size())
        return;
    g_slots[at].process = process;
    g_slots[at].state.store(Slot::HasProcess);
    slot_ = at;
}

EndsWithProgram::~EndsWithProgram()
{
    if (slot_ != kNowhere)
        g_slots[slot_].state.store(Slot::Free);
}

EndsWithProgram::EndsWithProgram(EndsWithProgram&& other) noexcept
    : slot_(std::exchange(other.slot_, kNowhere))
{}

EndsWithProgram& EndsWithProgram::operator=(EndsWithProgram&& other) noexcept
{
    std::swap(slot_, other.slot_);
    return *this;
}

} // namespace fx::cli
