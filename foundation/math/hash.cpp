#include "foundation/math/hash.h"

#include <xxhash.h>

namespace fx::base {

uint64_t hashBytes(uint64_t hash, const void* data, size_t size)
{
    return hashWord(XXH3_64bits_withSeed(data, size, hash), size);
}

} // namespace fx::base
