within PreloadedSprings;
package Damping "Damping laws of the joystick"
  extends PreloadedSprings.Icons.Package;
end Damping;
