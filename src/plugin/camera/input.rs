//! Mouse, touch, keyboard and gamepad as one wish.

use bevy::input::gamepad::Gamepad;
use bevy::input::mouse::{AccumulatedMouseMotion, AccumulatedMouseScroll, MouseScrollUnit};
use bevy::input::touch::Touches;
use bevy::prelude::*;

use crate::camera::VisitorWish;

/// Everything a visitor may hold or touch.
#[derive(bevy::ecs::system::SystemParam)]
pub(in crate::plugin) struct Devices<'w, 's> {
    keys: Option<Res<'w, ButtonInput<KeyCode>>>,
    buttons: Option<Res<'w, ButtonInput<MouseButton>>>,
    motion: Option<Res<'w, AccumulatedMouseMotion>>,
    scroll: Option<Res<'w, AccumulatedMouseScroll>>,
    touches: Option<Res<'w, Touches>>,
    gamepads: Query<'w, 's, &'static Gamepad>,
}

/// Turn in radians for a drag over one logical pixel.
const TURN_PER_PIXEL: f64 = 0.0012;
/// Step in scales for one notch of the wheel, and for one pixel of a trackpad or pinch.
const STEP_PER_NOTCH: f64 = 0.04;
const STEP_PER_PIXEL: f64 = 0.0015;
/// Turn of a fully deflected stick, radians a second.
const TURN_PER_SECOND: f64 = 0.6;
/// A stick nearer to its middle than this rests.
const DEAD_ZONE: f32 = 0.12;

/// What the devices ask for in this frame; a pointer that stirs the water asks for nothing.
pub(super) fn wish(devices: &Devices, stirs: bool, seconds: f64) -> VisitorWish {
    let mut wish = VisitorWish::default();
    keyboard(devices, &mut wish);
    pointer(devices, &mut wish);
    touch(devices, &mut wish);
    if stirs {
        wish.look = default();
    }
    for gamepad in &devices.gamepads {
        stick(gamepad, seconds, &mut wish);
    }
    wish
}

fn keyboard(devices: &Devices, wish: &mut VisitorWish) {
    let Some(keys) = &devices.keys else { return };
    let axis = |more: [KeyCode; 2], less: [KeyCode; 2]| {
        f64::from(u8::from(keys.any_pressed(more))) - f64::from(u8::from(keys.any_pressed(less)))
    };
    wish.lean.x += axis([KeyCode::KeyD, KeyCode::ArrowRight], [KeyCode::KeyA, KeyCode::ArrowLeft]);
    wish.lean.y += axis([KeyCode::KeyE, KeyCode::PageUp], [KeyCode::KeyQ, KeyCode::PageDown]);
    wish.step += axis([KeyCode::KeyW, KeyCode::ArrowUp], [KeyCode::KeyS, KeyCode::ArrowDown]);
    wish.go_home |= keys.just_pressed(KeyCode::Home);
}

fn pointer(devices: &Devices, wish: &mut VisitorWish) {
    if let (Some(buttons), Some(motion)) = (&devices.buttons, &devices.motion)
        && buttons.any_pressed([MouseButton::Left, MouseButton::Right])
    {
        // The picture follows the hand.
        let drag = motion.delta.as_dvec2() * TURN_PER_PIXEL;
        wish.look += drag;
    }
    if let Some(scroll) = &devices.scroll {
        let per_unit = match scroll.unit {
            MouseScrollUnit::Line => STEP_PER_NOTCH,
            MouseScrollUnit::Pixel => STEP_PER_PIXEL,
        };
        wish.advance += f64::from(scroll.delta.y) * per_unit;
    }
}

fn touch(devices: &Devices, wish: &mut VisitorWish) {
    let Some(touches) = &devices.touches else { return };
    let fingers: Vec<_> = touches.iter().collect();
    match fingers[..] {
        [finger] => wish.look += finger.delta().as_dvec2() * TURN_PER_PIXEL,
        [a, b, ..] => {
            let before = a.previous_position().distance(b.previous_position());
            let now = a.position().distance(b.position());
            wish.advance += f64::from(now - before) * STEP_PER_PIXEL;
            wish.look += (a.delta() + b.delta()).as_dvec2() * (0.5 * TURN_PER_PIXEL);
        }
        [] => {}
    }
}

fn stick(gamepad: &Gamepad, seconds: f64, wish: &mut VisitorWish) {
    let live = |stick: Vec2| if stick.length() > DEAD_ZONE { stick.as_dvec2() } else { default() };
    let (left, right) = (live(gamepad.left_stick()), live(gamepad.right_stick()));
    wish.lean.x += left.x;
    wish.step += left.y;
    wish.look += bevy::math::DVec2::new(-right.x, right.y) * (TURN_PER_SECOND * seconds);
    let pressed = |button| f64::from(u8::from(gamepad.pressed(button)));
    wish.lean.y += pressed(GamepadButton::RightTrigger) - pressed(GamepadButton::LeftTrigger);
    wish.go_home |= gamepad.just_pressed(GamepadButton::Start);
}
