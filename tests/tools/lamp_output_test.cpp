// process: where `phare lamp` writes its results: standard output, links, pipes, devices, a full disk.
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <string>
#include <vector>

#include "lamp_program.h"

namespace phare {
namespace {

class LampOutput : public test::LampProgram {
 protected:
  std::string angles_ = file("at.csv", "h_deg,v_deg\n0,-1\n2.5,-0.5\n");
  std::string table_ = "table " + ours("low_rht.ies") + " --at " + angles_ + " ";
};

TEST_F(LampOutput, TableGoesToStandardOutputByDefault) {
  const Said plain = lamp(table_);
  EXPECT_EQ(plain.code, 0) << plain.err;
  EXPECT_TRUE(plain.out.starts_with("h_deg,v_deg,intensity_cd\n0,-1,")) << plain.out;
  for (const char* name : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    const Said named = lamp(table_ + "--out " + name);
    EXPECT_EQ(named.code, 0) << name << named.err;
    EXPECT_EQ(named.out, plain.out) << name;
  }
  EXPECT_TRUE(std::filesystem::is_symlink("/dev/stdout"));
  // What `>>` began stays.
  const std::string grown = file("grown.csv", "kept\n");
  EXPECT_EQ(lamp(table_ + "--out /dev/stdout >> " + grown).code, 0);
  EXPECT_EQ(test::content_of(grown), "kept\n" + plain.out);
}

TEST_F(LampOutput, LinksStayLinksAndModesAreKept) {
  const std::string real = file("real.csv", "old"), link = in("link.csv"), loose = in("loose.csv");
  std::filesystem::create_symlink("real.csv", link);
  std::filesystem::create_symlink(in("not_yet.csv"), loose);
  std::filesystem::permissions(real, std::filesystem::perms(0640));
  EXPECT_EQ(lamp(table_ + "--out " + link).code, 0);
  EXPECT_EQ(lamp(table_ + "--out " + loose).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_TRUE(std::filesystem::is_symlink(loose));
  EXPECT_TRUE(test::content_of(real).starts_with("h_deg,"));
  EXPECT_EQ(test::content_of(real), test::content_of(in("not_yet.csv")));
  EXPECT_EQ(std::filesystem::status(real).permissions(), std::filesystem::perms(0640));
  std::filesystem::create_symlink("round.csv", in("round.csv"));
  EXPECT_EQ(lamp(table_ + "--out " + in("round.csv")).code, 2);
}

TEST_F(LampOutput, PipesAreWrittenToNotReplaced) {
  const std::string pipe = in("pipe"), out = in("from_pipe.csv");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const Said said = lamp(table_ + "--out " + pipe + " & cat " + pipe + " > " + out + "; wait $!");
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_TRUE(test::content_of(out).starts_with("h_deg,"));
}

TEST_F(LampOutput, AFullDiskIsReported) {
  // A device of our own of the kind of /dev/full, so that a mistake does not break the machine's.
  std::string full = in("full");
  if (::mknod(full.c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0) full = "/dev/full";
  for (const std::string& arguments :
       {table_ + "--out " + full, "convert " + ours("fog.ies") + " --to csv --out " + full}) {
    const Said said = lamp(arguments);
    EXPECT_EQ(said.code, 2) << arguments;
    EXPECT_NE(said.err.find("No space left on device"), std::string::npos) << said.err;
  }
  EXPECT_TRUE(std::filesystem::is_character_file(full));
  EXPECT_EQ(lamp(table_ + "--out " + folder_.string()).code, 2);
}

TEST_F(LampOutput, WhatIsPrintedOntoAFullDiskIsReported) {
  std::string full = in("full");
  if (::mknod(full.c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0) full = "/dev/full";
  const std::string low = ours("low_rht.ies"), examples = source_dir() + "/config/examples/";
  const std::string dbc = source_dir() + "/config/cockpits/phare_stalk.dbc";
  for (const std::string& arguments : std::vector<std::string>{
           "lamp info " + low, "lamp info " + low + " --json", "lamp check --list", "rig new --lamp " + low,
           "can list " + dbc, "can decode " + examples + "stalk.log --csv --dbc " + dbc, "manual", "help-data",
           "completion bash", "--help", "--version"}) {
    const Said said = phare(arguments + " > " + full);
    EXPECT_EQ(said.code, 2) << arguments;
    EXPECT_NE(said.err.find("phare: standard output: cannot be written: No space left on device\n"), std::string::npos)
        << arguments << "\n"
        << said.err;
  }
  // A reader who has left misses nothing.
  const Said left = phare("--version; { { sleep 1; \"" + program("phare") + "\" help-data; echo $? >&2; } | true; }");
  EXPECT_EQ(left.err, "141\n");
}

// A dash is standard output, and standard input, for every command that has one result or reads one file.
TEST_F(LampOutput, ADashIsNoFile) {
  const std::string low = ours("low_rht.ies"), config = source_dir() + "/config/";
  for (const std::string arguments : {"manual", "help-data", "completion zsh"}) {
    const Said plain = phare(arguments), dash = phare(arguments + " --out -");
    EXPECT_EQ(dash.code, 0) << dash.err;
    EXPECT_FALSE(plain.out.empty());
    EXPECT_TRUE(dash.out == plain.out) << arguments;
  }
  const Said rig = phare("rig new --lamp " + low), dash = phare("rig new --lamp " + low + " --out -");
  EXPECT_EQ(dash.code, 0) << dash.err;
  EXPECT_EQ(dash.out, rig.out);
  const std::string import = "import --can " + config + "examples/car.log --dbc " + config +
                             "examples/car.dbc --pose " + config + "examples/car_pose.csv --out ";
  const Said kept = phare(import + in("car.pcap")), given = phare(import + "-");
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_EQ(given.code, 0) << given.err;
  EXPECT_TRUE(given.out == test::content_of(in("car.pcap")));
  EXPECT_EQ(phare("can list - < " + config + "cockpits/phare_stalk.dbc").out,
            phare("can list " + config + "cockpits/phare_stalk.dbc").out);
  EXPECT_EQ(phare("can decode - --dbc " + config + "cockpits/phare_stalk.dbc < " + config + "examples/stalk.log").out,
            phare("can decode " + config + "examples/stalk.log --dbc " + config + "cockpits/phare_stalk.dbc").out);
}

TEST_F(LampOutput, ConvertWritesToStandardOutput) {
  const Said said = lamp("convert " + ours("fog.ies") + " --to lm63 --out -");
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_TRUE(said.out.starts_with("IES:LM-63-2019\n"));
  EXPECT_EQ(said.out.find("worst difference"), std::string::npos);
  EXPECT_NE(said.err.find("worst difference"), std::string::npos) << said.err;
}

}  // namespace
}  // namespace phare
