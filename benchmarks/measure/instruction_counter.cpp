#include "benchmarks/measure/instruction_counter.h"

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace fx::cli {

InstructionCounter::InstructionCounter()
{
    perf_event_attr attributes = {};
    attributes.type = PERF_TYPE_HARDWARE;
    attributes.size = sizeof attributes;
    attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
    attributes.disabled = 1;
    attributes.inherit = 1;
    attributes.exclude_kernel = 1;
    attributes.exclude_hv = 1;
    descriptor_ = int(syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

InstructionCounter::~InstructionCounter()
{
    if (descriptor_ >= 0)
        close(descriptor_);
}

void InstructionCounter::start()
{
    if (descriptor_ < 0)
        return;
    ioctl(descriptor_, PERF_EVENT_IOC_RESET, 0);
    ioctl(descriptor_, PERF_EVENT_IOC_ENABLE, 0);
}

double InstructionCounter::stop()
{
    uint64_t count = 0;
    if (descriptor_ < 0)
        return 0;
    ioctl(descriptor_, PERF_EVENT_IOC_DISABLE, 0);
    return read(descriptor_, &count, sizeof count) == ssize_t(sizeof count) ? double(count) : 0;
}

} // namespace fx::cli
