#include "foundation/memory/arena.h"

#include <algorithm>

namespace fx::base {

namespace {
constexpr size_t kAlignment = 64;
}

Arena::Arena(std::pmr::memory_resource* upstream, size_t blockSize)
    : upstream_(upstream), blockSize_(blockSize), blocks_(upstream)
{}

Arena::~Arena()
{
    releaseBlocks();
}

void* Arena::allocateBytes(size_t size)
{
    const size_t rounded = (std::max<size_t>(size, 1) + kAlignment - 1) / kAlignment * kAlignment;
    if (blocks_.empty() || blocks_.back().size - blocks_.back().used < rounded)
        addBlock(std::max(rounded, blockSize_));
    Block& block = blocks_.back();
    void* memory = block.memory + block.used;
    block.used += rounded;
    return memory;
}

void Arena::reset()
{
    if (blocks_.size() > 1) {
        size_t total = 0;
        for (const Block& block : blocks_)
            total += block.size;
        releaseBlocks();
        addBlock(total + total / 4); // the next frame may need a little more
    }
    if (!blocks_.empty())
        blocks_.back().used = 0;
}

void Arena::addBlock(size_t size)
{
    blocks_.reserve(blocks_.size() + 1); // so that push_back cannot throw after the block exists
    blocks_.push_back({static_cast<std::byte*>(upstream_->allocate(size, kAlignment)), size, 0});
}

void Arena::releaseBlocks()
{
    for (const Block& block : blocks_)
        upstream_->deallocate(block.memory, block.size, kAlignment);
    blocks_.clear();
}

} // namespace fx::base
