#include "core/base/registry.h"

#include <gmock/gmock.h>

#include <thread>

namespace kinemesh {
namespace {

struct Info {
  std::string name;
  int number = 0;
};

using testing::ElementsAre;
using testing::Field;

TEST(Registry, KnowsWhatIsBuiltInAndWhatWasAdded) {
  Registry<Info> all("thing", {{"one", 1}, {"two", 2}});
  const Info* const one = &all.find("one");
  for (int i = 3; i < 200; ++i) all.add({std::to_string(i), i});
  EXPECT_EQ(&all.find("one"), one) << "addresses last";
  EXPECT_EQ(all.find("77").number, 77);
  const auto listed = all.all();
  ASSERT_EQ(listed.size(), 199u);
  for (std::size_t i = 0; i < listed.size(); ++i) EXPECT_EQ(listed[i].number, static_cast<int>(i) + 1);
}

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Registry, NamesWhatItDoesNotKnow) {
  Registry<Info> all("thing", {{"one", 1}, {"two", 2}});
  EXPECT_EQ(message_of([&] { (void)all.find("on"); }), "unknown thing \"on\", expected one of one, two");
  EXPECT_EQ(message_of([&] { all.add({"two", 3}); }), "there is already a thing \"two\"");
  EXPECT_EQ(message_of([&] { all.add({"", 3}); }), "a thing without a name");
  EXPECT_THAT(all.all(), ElementsAre(Field(&Info::number, 1), Field(&Info::number, 2)));
}

TEST(Registry, TakesThingsFromSeveralThreads) {
  Registry<Info> all("thing", {});
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&all, t] {
      for (int i = 0; i < 500; ++i) {
        const std::string name = std::to_string(t) + "-" + std::to_string(i);
        all.add({name, i});
        EXPECT_EQ(all.find(name).number, i);
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(all.all().size(), 2000u);
}

}  // namespace
}  // namespace kinemesh
