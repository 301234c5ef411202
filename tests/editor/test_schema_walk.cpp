/// Every member of the product's schemas can be edited and undone by the means of the inspector.

#include "fxsdk/editor/inspector/member.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

/// Two valid values that differ, for a member of any kind.
std::vector<Json> valuesFor(const Member& member)
{
    const double least = member.minimum.value_or(0.0);
    const double most = member.maximum.value_or(least + 1.0);
    const Json low = limited(member, least);
    const Json high = limited(member, most);
    switch (member.kind) {
    case MemberKind::Choice:
        return {member.choices.front(), member.choices.back()};
    case MemberKind::Boolean:
        return {true, false};
    case MemberKind::Text:
        return {"first", "second"};
    case MemberKind::Range:
        return {low, Json{{"min", low}, {"max", high}}};
    case MemberKind::Curve:
        return {low, Json{{"keys", {{0, low}, {1, high}}}}};
    case MemberKind::ColorCurve:
        return {{low, low, low}, Json{{"keys", {{0, {low, low, high}}}}}};
    case MemberKind::Extent:
        return {low, {low, low, high}};
    case MemberKind::Vector:
    case MemberKind::Color:
        return {{low, low, low}, {low, low, high}};
    case MemberKind::Steps:
        return {low, Json{{"steps", {{0, low}, {1, high}}}}};
    case MemberKind::Switches:
        return {true, Json{{"steps", {{0, true}, {1, false}}}}};
    default:
        return {low, high};
    }
}

/// Counts members, and edits each of them.
class Walk
{
public:
    explicit Walk(const std::string& name) : document_(*Document::fromText("{\"version\": 1}", name)) {}

    void object(const std::string& pointer)
    {
        for (const Member& member : membersOf(document_, pointer))
            one(member);
    }
    size_t leaves() const { return leaves_; }

private:
    void one(const Member& member)
    {
        EXPECT_FALSE(member.help.empty()) << member.pointer;
        EXPECT_FALSE(member.title.empty()) << member.pointer;
        if (member.kind == MemberKind::Object)
            return inside(member, member.pointer, Json::object());
        if (member.kind == MemberKind::Array)
            return inside(member, member.pointer + "/0", Json::array());
        ++leaves_;
        for (const Json& value : valuesFor(member)) {
            EXPECT_TRUE(check(member, value).ok()) << check(member, value).message();
            edit(member.pointer, value);
        }
    }

    /// Adds the container and goes on with its members, which are removed afterwards.
    void inside(const Member& member, const std::string& pointer, const Json& empty)
    {
        const std::string before = document_.text();
        const size_t done = document_.history().done();
        if (empty.is_array()) {
            const Json& items = (*member.schema)["items"];
            EXPECT_TRUE(
                document_.insert(member.pointer, 0, startValue(items.is_array() ? items[0] : items)).ok());
        } else if (!member.isPresent) {
            EXPECT_TRUE(document_.set(member.pointer, empty).ok()) << member.pointer;
        }
        const auto inner = memberAt(document_, pointer);
        ASSERT_TRUE(inner.has_value()) << pointer;
        if (inner->kind == MemberKind::Object)
            object(pointer);
        else if (empty.is_array())
            one(*inner);
        while (document_.history().done() > done)
            document_.undo();
        EXPECT_EQ(document_.text(), before) << pointer;
    }

    void edit(const std::string& pointer, const Json& value)
    {
        const std::string before = document_.text();
        const size_t done = document_.history().done();
        ASSERT_TRUE(document_.set(pointer, value).ok()) << pointer;
        EXPECT_EQ(document_.json().at(Json::json_pointer(pointer)), value) << pointer;
        if (document_.history().done() == done)
            return; // it had this value
        ASSERT_TRUE(document_.undo());
        EXPECT_EQ(document_.text(), before) << pointer;
    }

    Document document_;
    size_t leaves_ = 0;
};

TEST(SchemaWalk, everyMemberOfPresetsCanBeEditedAndUndone)
{
    Walk walk("a.fx.json");
    walk.object("");
    EXPECT_GT(walk.leaves(), 300u);
    RecordProperty("members", int(walk.leaves()));
    std::printf("%zu members of presets\n", walk.leaves());
}

TEST(SchemaWalk, everyMemberOfScenesCanBeEditedAndUndone)
{
    Walk walk("a.scene.json");
    walk.object("");
    EXPECT_GT(walk.leaves(), 50u);
    std::printf("%zu members of scenes\n", walk.leaves());
}

} // namespace
} // namespace fx::editor
