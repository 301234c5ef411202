/// @file member.h
/// Describes the members of an object for an inspector, as the JSON Schema of the product defines them.
#pragma once

#include "fxsdk/editor/document/document.h"

#include <optional>
#include <string>
#include <vector>

namespace fx::editor {

/// How a member is edited.
enum class MemberKind
{
    Number,
    Integer,
    Boolean,
    Text,
    Choice,     ///< one of `choices`
    Range,      ///< a number, or {"min": a, "max": b}
    Curve,      ///< a number, or {"keys": [[t, value], ...]} with t from 0 to 1
    ColorCurve, ///< a color, or {"keys": [[t, color], ...]}
    Color,      ///< [r, g, b], linear Rec. 709
    Vector,     ///< [x, y, z]
    Extent,     ///< a number, or [x, y, z]
    Steps,      ///< a number, or {"steps": [[time, value], ...]}
    Switches,   ///< true, false, or {"steps": [[time, value], ...]}
    Object,
    Array
};

/// A member that the schema defines, present or not.
struct Member
{
    std::string name;    ///< in the file
    std::string pointer; ///< JSON pointer in the document
    std::string title;   ///< for people
    std::string help;    ///< description in the schema
    std::string cost;    ///< what it costs; empty: nothing stated
    std::string unit;    ///< such as "m/s"; empty: none
    MemberKind kind = MemberKind::Text;
    std::optional<double> minimum; ///< of each number of the value
    std::optional<double> maximum;
    std::vector<Json> choices;        ///< of Choice
    std::optional<Json> defaultValue; ///< value of an absent member; empty: the schema states none
    bool isRequired = false;
    bool isPresent = false; ///< whether the document has the member
    const Json* schema = nullptr;

    bool isNumeric() const { return kind == MemberKind::Number || kind == MemberKind::Integer; }
};

/// Describes the members of the object at `pointer`, in the order of the schema; empty if the schema defines
/// none. @param pointer "" for the document
std::vector<Member> membersOf(const Document& document, const std::string& pointer);

/// Describes the elements of the array at `pointer`. Their name is their index.
std::vector<Member> elementsOf(const Document& document, const std::string& pointer);

/// Describes one member, present or not; nothing if the schema does not define it.
std::optional<Member> memberAt(const Document& document, const std::string& pointer);

/// Names of members at `pointer` that the schema does not define.
std::vector<std::string> unknownMembersOf(const Document& document, const std::string& pointer);

/// Value that an absent member of the preview of a preset has because the object around it is absent, such as
/// the sun of the stage on which effects stand; empty: none.
std::optional<Json> impliedValue(const Document& document, const std::string& pointer);

/// Value of a member: that of the document, otherwise that which holds without the member, otherwise
/// startValue().
Json valueOf(const Document& document, const Member& member);

/// Whether valueOf() is what holds, not only a value to begin with.
bool hasValue(const Document& document, const Member& member);

/// Sets a member. An object around it that is absent gets its required members and the values that held
/// without it, so that one number does not change the others. @return as Document::set()
base::Status setMember(Document& io, const std::string& pointer, Json value, uint64_t gesture = 0);

/// A valid value for a member without a default, such as the smallest number of its range.
Json startValue(const Json& schema);

/// Whether the document has a value that differs from the default.
bool differsFromDefault(const Document& document, const Member& member);

/// Checks a value against type, range and choices. @return InvalidArgument that states what is allowed
base::Status check(const Member& member, const Json& value);

/// A number limited to the range of the member; whole for Integer.
Json limited(const Member& member, double value);

} // namespace fx::editor
