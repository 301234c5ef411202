#include "fxsdk/cli/interrupt.h"

#include <csignal>

namespace fx::cli {
namespace {

volatile std::sig_atomic_t g_requested = 0;

void onSignal(int)
{
    g_requested = 1;
}

} // namespace

void installInterruptHandler()
{
    struct sigaction action = {};
    action.sa_handler = onSignal;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, nullptr);
}

bool interruptRequested()
{
    return g_requested != 0;
}

base::Status interruptedStatus()
{
    return {base::Code::Interrupted, "interrupted"};
}

} // namespace fx::cli
