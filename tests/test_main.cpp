// main() of every test program: a folder of its own for what its tests write, as several run beside one another.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  std::string folder = testing::TempDir() + "phare-test-XXXXXX";
  if (!mkdtemp(folder.data())) {
    std::perror(folder.c_str());
    return 1;
  }
  setenv("TEST_TMPDIR", folder.c_str(), 1);  // what testing::TempDir() gives from here on
  const int failed = RUN_ALL_TESTS();
  std::error_code ignored;
  if (!failed) std::filesystem::remove_all(folder, ignored);  // what a failed one wrote is worth a look
  return failed;
}
