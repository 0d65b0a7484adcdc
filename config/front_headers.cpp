// Nothing but a place to compile the headers that the programs' front files share; see the end of CMakeLists.txt.
