// Stands in for the Arduino core: the clock and the serial port are the test's.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

using std::max;
using std::min;
#define PROGMEM
#define pgm_read_word(address) (*(const uint16_t *)(address))

extern uint32_t now_ms;
inline uint32_t millis() { return now_ms; }
inline void delay(uint32_t ms) { now_ms += ms; }

struct Port {
  std::string received;
  void begin(long) {}
  int available() { return (int)received.size(); }
  int read() {
    char letter = received[0];
    received.erase(0, 1);
    return letter;
  }
  template <class T> void print(T value) { std::cout << value; }
  template <class T> void println(T value) { std::cout << value << "\n"; }
};
extern Port Serial;
