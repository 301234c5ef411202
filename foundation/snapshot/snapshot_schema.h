/// @file snapshot_schema.h
/// The kinds of data that a snapshot can contain. Techniques register their kinds; the snapshot container
/// depends on no kind.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace fx::base {

/// Element type of a column.
enum class ColumnType : uint8_t
{
    F32,
    U64,
};

constexpr size_t columnElementSize(ColumnType type)
{
    return type == ColumnType::F32 ? 4 : 8;
}

/// One attribute of the elements of a kind. Names and units are string literals.
struct ColumnDesc
{
    std::string_view name;
    std::string_view unit; ///< SI unit; "1" if the attribute has none
    ColumnType type = ColumnType::F32;
};

/// A kind of element: the columns of each element, and the constants that all elements of a group share.
struct KindDesc
{
    std::string_view name;
    std::span<const ColumnDesc> columns;   ///< columns, with one value per element
    std::span<const ColumnDesc> constants; ///< constants, with one value per group; all are F32
    /// True: elements have ids and are sorted by id. False: the kind defines another way to match elements of
    /// two snapshots.
    bool hasIds = true;

    /// Two kinds are equal if their names are equal.
    bool operator==(const KindDesc& other) const { return name == other.name; }
};

constexpr size_t kMaxColumns = 24;   ///< largest number of columns of a kind
constexpr size_t kMaxConstants = 24; ///< largest number of constants of a kind

using KindId = uint32_t;
constexpr KindId kNoKind = ~0u;

/// Set of columns of a kind that a group has: bit i stands for column i.
using ColumnSet = uint64_t;
constexpr ColumnSet kAllColumns = ~ColumnSet(0);

/// The kinds of one context. Kinds are added while the context is created; afterwards the schema is constant.
class SnapshotSchema
{
public:
    /// Registers `kind` and returns its id; if the name is already registered, returns the existing id.
    /// Throws std::length_error if `kind` has more than kMaxColumns columns or kMaxConstants constants.
    KindId add(const KindDesc& kind);
    KindId find(std::string_view name) const; ///< kNoKind if the kind is not registered
    const KindDesc& kind(KindId id) const { return kinds_[id]; }
    size_t size() const { return kinds_.size(); }

private:
    std::vector<KindDesc> kinds_;
};

} // namespace fx::base
