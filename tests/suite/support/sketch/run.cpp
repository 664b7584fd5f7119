// Runs the sketch against lines of the standard input: a time in ms, and what arrives then. Prints the replies, and at every time the pulses.
#include "sketch.ino"

uint32_t now_ms = 0;
Port Serial;
Bus Wire;

int main() {
  setup();
  uint32_t due;
  std::string words;
  while (std::cin >> due && std::getline(std::cin, words)) {
    while (now_ms < due) {
      now_ms++;
      loop();
    }
    words.erase(0, words.find_first_not_of(' '));
    if (!words.empty()) Serial.received = words + "\n";
    loop();
    std::cout << "@" << now_ms;
    for (int i = 0; i < SERVOS; i++) std::cout << " " << Wire.off[i];
    std::cout << "\n";
  }
}
