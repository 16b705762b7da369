#include "renderer/kept_table.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "image/io.h"
#include "image/test_folder.h"

namespace sheen::renderer {
namespace {

using albedo::Visibility;

TEST(KeptTable, IsThatWhichIsBuiltToTheBit) {
  const image::TestFolder folder;
  const KeptImages kept(folder.path());
  for (const Visibility visibility : {Visibility::Charlie, Visibility::Ashikhmin}) {
    const albedo::Table built = albedo::build_table(visibility);
    for (const char* when : {"made", "read"}) {
      const albedo::Table table = kept_table(kept, visibility);
      EXPECT_EQ(table.visibility, visibility) << when;
      EXPECT_EQ(table.values, built.values) << when;
    }
  }
}

TEST(KeptTable, IsReadWhereItWasKeptAndMadeAnewWhereItIsDamaged) {
  const image::TestFolder folder;
  const KeptImages kept(folder.path());
  const albedo::Table built = kept_table(kept, Visibility::Charlie);
  const std::filesystem::path file = std::filesystem::directory_iterator(folder.path())->path();
  image::Image changed = image::read(file);
  changed.at(5, 0, 0) += 1.0F;
  image::write(file, changed);
  EXPECT_EQ(kept_table(kept, Visibility::Charlie).values[5], built.values[5] + 1.0F);
  image::write(file, image::Image(2, 2, {"R", "G", "B"}));
  EXPECT_EQ(kept_table(kept, Visibility::Charlie).values, built.values) << "of another size";
  std::ofstream(file) << "damaged";
  EXPECT_EQ(kept_table(kept, Visibility::Charlie).values, built.values);
  EXPECT_EQ(kept_table(KeptImages({}), Visibility::Charlie).values, built.values) << "kept nowhere";
}

}  // namespace
}  // namespace sheen::renderer
