#include "fxsdk/editor/document/snapshots.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

TEST(Snapshots, restoringIsAnEditThatCanBeUndone)
{
    auto document = Document::fromText("{\n  \"version\": 1,\n  \"name\": \"a\"\n}\n", "a.fx.json");
    ASSERT_TRUE(document.ok());
    Snapshots snapshots;
    EXPECT_FALSE(snapshots.restore(0, *document));
    snapshots.take(0, *document);
    ASSERT_TRUE(document->set("/name", "b").ok());
    EXPECT_EQ(toString(snapshots.differenceFrom(0, *document)),
              " {\n   \"version\": 1,\n-  \"name\": \"a\"\n+  \"name\": \"b\"\n }\n");
    ASSERT_TRUE(snapshots.restore(0, *document));
    EXPECT_FALSE(document->isDirty());
    ASSERT_TRUE(document->undo());
    EXPECT_EQ(document->json()["name"], "b");
}

} // namespace
} // namespace fx::editor
