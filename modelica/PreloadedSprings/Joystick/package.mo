within PreloadedSprings;
package Joystick "The joystick of the paper and its parts"
  extends PreloadedSprings.Icons.Package;
end Joystick;
