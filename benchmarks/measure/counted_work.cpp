#include "benchmarks/measure/counted_work.h"

#include "benchmarks/measure/clocks.h"
#include "benchmarks/measure/instruction_counter.h"

extern "C" [[gnu::noinline]] void fxAccuracyWork(const std::function<void()>* work)
{
    (*work)();
}

namespace fx::cli {

MeasuredWork measureWork(const std::function<void()>& work)
{
    static InstructionCounter counter; // of the thread that measures first, and of what it starts
    MeasuredWork measured;
    counter.start();
    const double begin = threadSeconds();
    fxAccuracyWork(&work);
    measured.seconds = threadSeconds() - begin;
    measured.instructions = counter.stop();
    return measured;
}

} // namespace fx::cli
