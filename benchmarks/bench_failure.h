/// @file bench_failure.h
/// How a benchmark ends when it cannot go on.
#pragma once

#include "foundation/result/status.h"

#include <cerrno> // program_invocation_short_name
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

namespace fx::bench {

/// Exit code 1, and why under the program's name.
[[noreturn]] inline void fail(const std::string& what)
{
    std::fprintf(stderr, "%s: %s\n", program_invocation_short_name, what.c_str());
    std::exit(1);
}

template <class T>
T taken(base::Result<T>&& result)
{
    if (!result.ok())
        fail(result.status().message());
    return std::move(*result);
}

} // namespace fx::bench
