// What of the desk decides which pipelines a picture takes, and so what has to be made before it can follow. Pure.
// Checked by tests/visual_process/picture_kind_test.cpp.
#pragma once

#include "config/desk.h"

namespace phare {

/// Pictures of both take the same pipelines, of the same car in the same place: how much falls or lies, from where it
/// is seen and what is written over it make nothing new.
bool same_kind(const Desk& a, const Desk& b);

/// The desk as `asked`, but for what decides which pipelines a picture takes: that is as `shown`.
Desk with_kind_of(Desk asked, const Desk& shown);

}  // namespace phare
