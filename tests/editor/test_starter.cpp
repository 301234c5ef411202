#include "fxsdk/editor/document/document_findings.h"
#include "fxsdk/editor/document/starter.h"
#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace fx::editor {
namespace {

TEST(NewDocument, hasTheNameOfItsFileAndNoFindings)
{
    test::TemporaryFolder folder;
    for (const char* name : {"camp \"fire\".fx.json", "camp \"fire\".scene.json"}) {
        auto document = newDocument((folder / name).string());
        ASSERT_TRUE(document.ok()) << document.status().message();
        EXPECT_EQ(document->json()["name"], "camp \"fire\"");
        const auto findings = findingsOf(*document);
        EXPECT_TRUE(findings.empty()) << findings.front().diagnostic.message;
        EXPECT_FALSE(std::filesystem::exists(folder / name));
        ASSERT_TRUE(document->save().ok());
        auto again = Document::open((folder / name).string());
        ASSERT_TRUE(again.ok());
        EXPECT_EQ(again->json(), document->json());
    }
}

TEST(NewDocument, refusesFilesThatExistMissingFoldersAndOtherNames)
{
    test::TemporaryFolder folder;
    std::ofstream(folder / "old.fx.json") << "{}";
    EXPECT_EQ(newDocument((folder / "old.fx.json").string()).status().code(), base::Code::InvalidArgument);
    EXPECT_EQ(newDocument((folder / "none" / "new.fx.json").string()).status().code(), base::Code::NotFound);
    for (const char* name : {"new", "new.json", ".fx.json", ".scene.json", "library:sparks"})
        EXPECT_EQ(newDocument((folder / name).string()).status().code(), base::Code::InvalidArgument) << name;
}

} // namespace
} // namespace fx::editor
