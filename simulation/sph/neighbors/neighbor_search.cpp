#include "simulation/sph/neighbors/neighbor_search.h"

#include "foundation/simd/instruction_set.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/sph/neighbors/neighbor_search.cpp"
#include <hwy/foreach_target.h>

#include "simulation/sph/neighbors/piece_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::HWY_NAMESPACE {

void listOwnersFloat(const SearchSetup<float>& setup, std::span<const uint32_t> owners, ListWriter& writer)
{
    ListSearch<float>(setup, writer).list(owners);
}
void listOwnersDouble(const SearchSetup<double>& setup, std::span<const uint32_t> owners, ListWriter& writer)
{
    ListSearch<double>(setup, writer).list(owners);
}
void searchOwnerFloat(const SearchSetup<float>& setup, uint32_t owner, ListPiece piece, void* argument)
{
    searchPieces(setup, owner, piece, argument);
}
void searchOwnerDouble(const SearchSetup<double>& setup, uint32_t owner, ListPiece piece, void* argument)
{
    searchPieces(setup, owner, piece, argument);
}

} // namespace fx::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

HWY_EXPORT(listOwnersFloat);
HWY_EXPORT(listOwnersDouble);
HWY_EXPORT(searchOwnerFloat);
HWY_EXPORT(searchOwnerDouble);

template <>
void listOwners(const SearchSetup<float>& setup, std::span<const uint32_t> owners, ListWriter& writer)
{
    HWY_DYNAMIC_DISPATCH(listOwnersFloat)(setup, owners, writer);
}
template <>
void listOwners(const SearchSetup<double>& setup, std::span<const uint32_t> owners, ListWriter& writer)
{
    HWY_DYNAMIC_DISPATCH(listOwnersDouble)(setup, owners, writer);
}
template <>
void searchOwner(const SearchSetup<float>& setup, uint32_t owner, ListPiece piece, void* argument)
{
    HWY_DYNAMIC_DISPATCH(searchOwnerFloat)(setup, owner, piece, argument);
}
template <>
void searchOwner(const SearchSetup<double>& setup, uint32_t owner, ListPiece piece, void* argument)
{
    HWY_DYNAMIC_DISPATCH(searchOwnerDouble)(setup, owner, piece, argument);
}

} // namespace fx::sim
#endif
