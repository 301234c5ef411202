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
    action.sa_flags = int(SA_RESETHAND); // the second one ends a program that does not listen to the first
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    action.sa_flags = 0;
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, nullptr); // writing beyond `ulimit -f` is an error like a full disk
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
