// A renderer of 320 x 180 pixels that the tests of a suite share, with Vulkan validation and synchronization validation
// on: one message fails the test.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "visual/renderer.h"

namespace phare {

class SharedRenderer : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Result<Renderer> made = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
    if (made)
      shared() = std::make_unique<Renderer>(std::move(*made));
    else
      why_not() = made.error().text();
  }
  static void TearDownTestSuite() { shared().reset(); }
  void SetUp() override {
    ASSERT_NE(shared(), nullptr) << why_not();
    renderer = shared().get();
  }
  void TearDown() override {
    if (renderer == nullptr) return;
    EXPECT_EQ(renderer->validation_messages(), 0u) << "messages of Vulkan validation stand above";
  }
  Renderer* renderer = nullptr;

 private:
  static std::unique_ptr<Renderer>& shared() {
    static std::unique_ptr<Renderer> renderer;
    return renderer;
  }
  static std::string& why_not() {
    static std::string reason;
    return reason;
  }
};

}  // namespace phare
